// [data] of a job: which files, and how their columns become canonical ones.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"

namespace frictab::data {

// How one canonical column is taken from a file.
struct ColumnSource {
  std::vector<std::string> names; // the file's own name; several = the first one present
  std::size_t number = 0;         // or the column's number in the file, from 1
  std::string unit;               // the file's unit; empty = canonical
  std::string times;              // a measured coefficient: multiplied with this canonical column
  double area_mm2 = 0;            // a force over this nominal area gives a stress
  std::size_t slope_rows = 0;     // |d column/d time| by a least-squares line over this many rows
  Place place;
};

struct DropRule {
  std::string column; // canonical
  std::optional<double> below;
  std::optional<double> above;
  Place place;
};

struct DataOptions {
  std::vector<std::string> training;
  std::vector<std::string> validation; // empty: `holdout` of the experiments is held out
  std::vector<std::string> oracle;     // synthetic data: files of the noise-free stress
  double holdout = 0.25;               // share of EXPERIMENTS
  char delimiter = 0;                  // 0: found from the header line (, ; tab | or blanks)
  char decimal = '.';
  std::size_t skip_rows = 0;   // preamble lines before the header
  std::size_t skip_footer = 0; // lines after the data
  bool units_row = false;      // a line of units below the header
  std::vector<DropRule> drop;
  std::map<std::string, ColumnSource> columns;        // by canonical name
  std::map<std::string, double> constants;            // by canonical name
  std::optional<std::vector<std::string>> bystanders; // other columns to keep; absent: all
  std::string base;                                   // directory that relative paths start from
  Place place;                                        // of [data] or of data.training
  Place oracle_place;
};

} // namespace frictab::data
