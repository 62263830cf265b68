// Folds of cross-validation: they part experiments, never the rows of one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "data/dataset.h"
#include "data/recordings.h"

namespace frictab::calibrate {

// The fold, 0 .. folds-1, of each experiment, drawn by seed and repeat. Fold sizes differ by one
// experiment at most, and no fold is empty. Throws InputError where there are fewer than 2 folds or
// fewer experiments than folds.
std::vector<std::size_t> experiment_folds(std::size_t experiments, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat);
// The same of units that are never parted: fold sizes then differ by one unit at most.
std::vector<std::size_t> experiment_folds(const data::Units& units, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat);

// For two files, where equal names prove nothing: says how many validation experiments have the
// very rows of a training experiment (data/equal_tests.h). Of the same data twice: how many have
// the rows of another. Empty where none has.
std::string leak_note(const data::Dataset& training, const data::Dataset& validation);

} // namespace frictab::calibrate
