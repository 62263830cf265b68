// Converts tables with one column per test into tables with one row per value.
#pragma once

#include <string>

#include "core/error.h"
#include "core/pattern.h"
#include "data/options.h"
#include "io/csv.h"

namespace frictab::data {

// Pattern for the names of columns that are one test each: the regular expression has to match the
// complete name. Throws InputError if it is invalid.
Pattern test_columns(const std::string& columns, const Place& place);

// Treats each column whose complete name matches the regular expression `columns` as one test. Its
// named groups become columns (numbers or texts); the group `experiment` names the test, otherwise
// the column's own name does; the group `column` names the column for the values, otherwise this is
// "value". All other columns (time, cycle) are repeated for every test. A test's rows end with its
// last non-empty cell. Throws InputError if no column matches, or if two columns of a test are the
// same.
io::CsvTable from_wide(const io::CsvTable& table, const std::string& columns, const Place& place);

// Treats each run of columns that begins with the name of the first one, and has the same names, as
// one test. Its name is the text over its first column, or else its number. Throws InputError if
// the first name does not come again, or if the runs differ in their names.
io::CsvTable from_side_by_side(const io::CsvTable& table);

// Whether the job has files with tests side by side.
bool are_side_by_side(const DataOptions& options);
// One row per value where the job has files with tests side by side; else the table itself.
io::CsvTable end_to_end(io::CsvTable&& table, const DataOptions& options);

} // namespace frictab::data
