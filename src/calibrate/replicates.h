// Recognition of experiments with the same set levels from the recorded columns.
#pragma once

#include <vector>

#include "data/dataset.h"

namespace frictab::calibrate {

// Groups replicates. Two experiments are replicates if every recorded model input agrees in each
// tenth of the rows, and every other column with one value per test agrees.
//
// Inputs agree if their means differ by at most 1 % of the input's range in `data`, in ln where the
// input spans decades (sigma_n_MPa, psi, v_rel_mm_s, sigma_f_MPa); by 2 % of a pressure, a speed or
// a path, by 1 K; or by the width of a level that is clearly apart from the next one. The noise of
// the means is added. An input with one level, up to these, does not distinguish experiments. Text,
// and levels that tests share, must be the same; a reading with its own value in each test (a
// humidity) agrees within the step it is written in or 1 % of its span. A column of few levels that
// change within tests (a direction) agrees if the shares of rows at each level do, to 0.1.
//
// Ignored are columns that count or name the tests, columns measured along with friction, and
// columns that Column::role marks as not being settings, unless they hold a text in every test.
// Intervals of one recording are not replicates of each other. Returns groups of at least 2, as
// indices of experiments; each experiment is in at most one group, that of the first experiment it
// agrees with. Empty if no varying column distinguishes experiments.
std::vector<std::vector<std::size_t>> replicate_groups(const data::Dataset& data);

constexpr double replicate_tolerance = 0.01;

} // namespace frictab::calibrate
