// A table with a row per test as people write it: a line of units below the names, and a legend or
// remarks below the last row.
#pragma once

#include "io/csv.h"

namespace frictab::data {

// Takes the line of units and leaves out the remarks, with a note.
io::CsvTable list_of_tests(io::CsvTable table);

} // namespace frictab::data
