// Splits for cross-validation that never cut through an experiment.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace frictab {

// The fold (0 .. folds-1) of each experiment: balanced, drawn by seed and repeat.
std::vector<std::size_t> experiment_folds(std::size_t experiments, std::size_t folds,
                                          std::uint64_t seed, std::uint64_t repeat);

} // namespace frictab
