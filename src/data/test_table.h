// data.tests: a file with one row per experiment (humidity, batch, operator), joined by its name.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "data/mapping.h"
#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

struct TestTable {
  std::string file;
  MappedFile columns;
  std::map<std::string, std::size_t> row;    // by experiment
  std::map<std::string, std::string> by_key; // by test_key of these, without those that share one
  std::map<long, std::string> numbered;      // by first_number of these; empty if two are equal

  // The table's name of an experiment: its own, the one with the same test_key(), or the only one
  // with the same number if is_same_test(); nullptr if there is none.
  const std::string* name_of(const std::string& experiment) const;
  // The same for a test of a dataset; an interval may have the row of its file.
  const std::string* name_of(const Dataset& data, std::size_t test) const;
  std::size_t header_line = 0;
};

// Reads data.tests in the dialect of [data], or that of a rule for this file: experiment,
// quantities (with their units) and other columns. A line of units below the names is taken as
// such; legends below the table are passed over. Quantities that [data.columns] maps to a column of
// this table are removed from `options`: the data files need not have them. Throws InputError for
// faults and for a test that occurs twice.
TestTable read_test_table(DataOptions& options);

// A name without folders, extension, capitals and zeros in front of its numbers: "bor_7" for
// "BoR/bor_007.csv".
std::string test_key(const std::string& name);
// The first whole number in a name: 1 in "Versuch_001_C45"; -1 if there is none.
long first_number(const std::string& name);
// True if two names have one first number, and their other words may be the same: "V01" and
// "Versuch_001_C45", but not "Al_1" and "Steel_1".
bool is_same_test(const std::string& a, const std::string& b);

// Throws InputError if two experiments stand for one row of the table because their numbers are
// equal. Intervals of one file may share a row.
void check_numbered(const TestTable& table, const Dataset& data);

// Adds the table's columns to the rows of each experiment. Adds a fault if an experiment is not in
// the table, or a column is in both.
void add_test_columns(Part& part, const TestTable& table);

} // namespace frictab::data
