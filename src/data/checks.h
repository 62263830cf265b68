// What cannot be in a file, told once per cause with its count.
#pragma once

#include <span>
#include <vector>

#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// Cells that are no numbers, in the rows that are kept; what was to be computed from such a cell
// follows them.
void tell_cells(Part& part);

// A contact normal stress: a column that is mapped and absent has had its fault already.
void check_needed(Part& part, const DataOptions& options);

// Quantities below their lowest value (friction may scatter about 0), and rows without load where
// eq. 1 divides by it.
void check_values(Part& part);

// Values that could not be computed though every cell of their row is a number; a measured stress
// where rows need none apart.
void check_computed(Part& part, const DataOptions& options);

// Whether rows stand for tests, not for a course: at least 8 and at most 1000 of them, with two
// columns or more that come back to few levels (a third of the rows at most), whose combinations
// change from row to row and come back in three rows at most. `settings`: columns that are no
// response, text as levels.
bool rows_look_like_tests(std::span<const std::vector<double>> settings, std::size_t rows);

// Time that goes back; rows that look like tests, where nobody says what a test is; tests of one
// row among others, where they are measured.
void check_experiments(Part& part, const DataOptions& options);

} // namespace frictab::data
