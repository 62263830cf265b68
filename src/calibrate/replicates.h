// Experiments with the same set levels, recognised by what was recorded.
#pragma once

#include <vector>

#include "data/dataset.h"

namespace frictab::calibrate {

// Two experiments are replicates where every recorded model input is alike in each tenth of the
// rows: the means differ by at most 1 % of the input's range in `data`, in ln where the input spans
// decades (sigma_n_MPa, psi, v_rel_mm_s, sigma_f_MPa), and every other column that was set is the
// same: text, and numbers that are constant within experiments and take few values (a material, a
// tool, an additive; what is merely measured, as humidity, or counts the tests, sets nothing).
// Groups of at least 2, as indices of experiments; each experiment is in one group at most, joined
// to the first experiment it is like. Empty where nothing that varies tells experiments apart.
std::vector<std::vector<std::size_t>> replicate_groups(const data::Dataset& data);

constexpr double replicate_tolerance = 0.01;

} // namespace frictab::calibrate
