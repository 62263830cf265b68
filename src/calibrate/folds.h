// Folds of cross-validation: they separate experiments, never the rows of one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/recordings.h"

namespace frictab::calibrate {

// Returns the fold, 0 .. folds-1, of each experiment, drawn by seed and repeat. Fold sizes differ
// by one experiment at most, and no fold is empty. Throws InputError if there are fewer than 2
// folds or fewer experiments than folds.
std::vector<std::size_t> experiment_folds(std::size_t experiments, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat);
// The same for units that stay together: fold sizes then differ by one unit at most.
std::vector<std::size_t> experiment_folds(const data::Units& units, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat);

// Experiments outside and inside one fold.
struct FoldParts {
  std::vector<std::size_t> in, out;
};
FoldParts parts_of(std::span<const std::size_t> fold_of, std::size_t fold);

// Warns about leakage between two files, where different names prove nothing: how many validation
// experiments have the same rows as a training experiment (data/equal_tests.h). If both are the
// same data: how many have the rows of another experiment. Also of rows that were changed a little.
// Empty if none does.
std::string leak_note(const data::Dataset& training, const data::Dataset& validation);

} // namespace frictab::calibrate
