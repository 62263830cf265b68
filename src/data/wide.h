// Tables with one column per test become tables with one row per value.
#pragma once

#include <string>

#include "core/error.h"
#include "core/pattern.h"
#include "io/csv.h"

namespace frictab::data {

// Finds the names of columns that are one test each: the regular expression fits all of the name,
// however it is written. Throws InputError where it is none.
Pattern test_columns(const std::string& columns, const Place& place);

// Columns whose whole name fits the regular expression `columns` are one test each. Its named
// groups become columns (numbers or texts); the group `experiment` names the test, else the
// column's own name does; the group `column` names the column that the values go to, else this is
// "value". All other columns (time, cycle) are repeated for every test. A test's rows end with its
// last cell that is not empty. Throws InputError where no column fits, or where two columns of a
// test are the same.
io::CsvTable from_wide(const io::CsvTable& table, const std::string& columns, const Place& place);

} // namespace frictab::data
