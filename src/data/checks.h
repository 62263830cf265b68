// Checks for impossible content of a file, reported once per cause with its count.
#pragma once

#include <span>
#include <vector>

#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// Reports cells of kept rows that are not numbers; a value that would be computed from such a cell
// is not reported again.
void report_odd_cells(Part& part);

// Reports a missing contact normal stress. A column that is mapped but absent has been reported
// before.
void check_needed(Part& part, const DataOptions& options);

// Reports quantities below their lowest value (friction may scatter about 0), and rows without load
// where eq. 1 divides by it.
void check_values(Part& part, const ReadRequest& options);

// Reports values that could not be computed although every cell of their row is a number; not a
// measured stress if the rows do not need one.
void check_computed(Part& part, const ReadRequest& options);

// True if rows look like tests rather than a time series: 8 to 1000 rows, with at least two columns
// that repeat few levels (at most a third of the number of rows). Combinations of these levels have
// to change from row to row, and each may occur in at most three rows. `settings`: the columns that
// are not responses, text as levels.
bool rows_look_like_tests(std::span<const std::vector<double>> settings, std::size_t rows);

// Whether the name is that of what goes on within a recording ("Cycle", "Position [mm]"), which no
// table of one row per test has.
bool counts_rows_of_a_test(const std::string& name);

// Reports time that decreases, rows that look like tests if the job does not define tests, and
// measured tests of one row among others.
void check_experiments(Part& part, const ReadRequest& options);

} // namespace frictab::data
