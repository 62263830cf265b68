// data.tests: a file with one row per experiment (humidity, batch, operator), joined by its name.
#pragma once

#include <map>
#include <string>

#include "data/mapping.h"
#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

struct TestTable {
  std::string file;
  MappedFile columns;
  std::map<std::string, std::size_t> row; // by experiment
  std::size_t header_line = 0;
};

// Reads data.tests in the dialect of [data]: experiment, quantities (with their units) and other
// columns. Where [data.columns] maps a quantity to a column that stands here, `options` is left
// without it: the data files need not have it. Throws InputError for faults and for a test that
// stands there twice.
TestTable read_test_table(DataOptions& options);

// The table's columns, for the rows of each experiment. A fault where an experiment is not in the
// table, or a column is in both.
void add_test_columns(Part& part, const TestTable& table);

} // namespace frictab::data
