// Experiments with the same set levels, recognised by what was recorded.
#pragma once

#include <vector>

#include "data/dataset.h"

namespace frictab::calibrate {

// Two experiments are replicates where every recorded model input is alike in each tenth of the
// rows: the means differ by at most 1 % of the input's range in `data`, in ln where the input spans
// decades (sigma_n_MPa, psi, v_rel_mm_s, sigma_f_MPa), and every other column of one value per test
// agrees: text and levels that tests share are the same, a reading of its own in each test (a
// humidity) within the step it is written in or 1 % of its span. A column of few levels that change
// within tests (a direction) agrees where the shares of rows do, to 0.1. What counts or names the
// tests, what is measured along with friction, and what Column::role says is no setting are not
// asked. Intervals of one recording are no replicates of each other.
// Groups of at least 2, as indices of experiments; each experiment is in one group at most, joined
// to the first experiment it is like. Empty where nothing that varies tells experiments apart.
std::vector<std::vector<std::size_t>> replicate_groups(const data::Dataset& data);

constexpr double replicate_tolerance = 0.01;

} // namespace frictab::calibrate
