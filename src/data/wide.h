// Converts tables with one column per test into tables with one row per value.
#pragma once

#include <string>

#include "core/error.h"
#include "core/pattern.h"
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

} // namespace frictab::data
