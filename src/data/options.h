// [data] of a job: the files, and the mapping of their columns to canonical ones.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"
#include "data/quantity.h"

namespace frictab::data {

// Source of one canonical column in a file.
struct ColumnSource {
  std::vector<std::string> names; // the file's own name; of several, the first one present
  std::size_t number = 0;         // or the column's number in the file, from 1
  std::string unit;               // the file's unit; empty = canonical
  std::string times;              // for a measured coefficient: canonical column to multiply it by
  double area_mm2 = 0;            // for a force: nominal area, which gives a stress
  std::size_t slope_rows = 0;     // |d column/d time| by a least-squares line over this many rows
  std::string formula;            // or computed from other columns (data/computed.h)
  Place place;
};

struct DropRule {
  std::string column; // canonical, a recorded column, or "experiment"
  std::optional<double> below;
  std::optional<double> above;
  Place place;
  std::vector<std::string> texts = {}; // of a text column, or names of tests
};

// Treatment of a quantity's empty cell: a fault, or its row is left out and counted.
enum class Missing { error, drop };

// Rows that are fitted (data/phases.h).
enum class UsedRows { sliding, all };

// Treatment of the force difference between the directions of a test (data/signs.h). automatic:
// decided by its dependence on the load; remove: subtracted as the zero of the force cell; keep:
// kept as friction.
enum class ForceZero { automatic, remove, keep };

// Regular expressions of lines that open and close a run of rows; empty: none.
struct SegmentRules {
  std::string begins, ends;
  Place place;
};

// Settings for some files; the first rule that matches a file applies. Rows are left out by the
// same rules in all files.
struct FileRule {
  std::string match; // a glob; matches the whole path if it contains a /
  std::optional<char> delimiter, decimal, thousands;
  std::optional<std::size_t> skip_rows, skip_footer;
  std::optional<bool> units_row, header;
  std::optional<std::size_t> header_rows;
  std::vector<std::string> sheets; // of a workbook
  SegmentRules segments;
  std::map<std::string, ColumnSource> columns;
  std::map<std::string, double> constants;   // canonical, or a new column
  std::map<std::string, std::string> labels; // text columns
  std::string from_name;                     // a regular expression with named groups
  std::string experiment;
  Place place, from_name_place;
};

// Role of a recorded column according to the job.
struct RoleWish {
  Role role = Role::undecided;
  Place place;
};

// A number, or "auto".
struct AutoNumber {
  std::optional<double> value;
};

// [data.join]: other files of the same tests with their own clock (data/join.h).
struct JoinOptions {
  std::vector<std::string> files; // empty: none
  std::string by = "time_s";      // or s_mm
  AutoNumber offset;              // added to their clock
  FileRule how;                   // how they are read; its match covers all of them
  Place place;
};

struct DataOptions {
  std::vector<std::string> training;
  std::vector<std::string> validation; // empty: leave-one-out, or some experiments held out
  std::vector<std::string> oracle;     // synthetic data: files of the noise-free stress
  std::optional<double> holdout;       // share of EXPERIMENTS; absent: by their number
  char delimiter = 0;                  // 0: detected from the header line (, ; tab | or blanks)
  char decimal = '.';
  char thousands = 0;          // between groups of three digits; 0: none
  std::size_t skip_rows = 0;   // preamble lines before the header
  std::size_t skip_footer = 0; // lines after the data
  bool units_row = false;      // a line of units below the header
  bool list = false;           // a row per test: texts between and below its rows are remarks
  // false: no line of names; absent: there is one, unless it would be numbers and the job takes
  // columns by number alone
  std::optional<bool> header;
  std::size_t header_rows = 1; // lines of names
  SegmentRules segments;
  std::vector<std::string> missing_values; // texts and numbers that stand for no value
  std::vector<std::string> fill_down;      // columns whose empty cells have the value above
  std::vector<std::string> sheets;         // of a workbook, names with *; empty: those of tests
  std::vector<DropRule> drop;
  std::map<std::string, ColumnSource> columns; // by canonical name
  // By canonical name; for one file also other columns.
  std::map<std::string, double> constants;
  std::map<std::string, std::string> labels; // text columns for one file
  // Definition of an experiment: "file", "interval" (from one header line to the next), "pause"
  // (what slides between two pauses, rows at rest or without load; data/signs.h), "row", "columns"
  // (those of equal names side by side are a test each), a column, or "file+COLUMN"; empty: the
  // column `experiment` if there is one, else the file.
  std::string experiment;
  // Experiments that are intervals of one recording: "none", those of a "file", those whose "name"
  // differs in its last number, or those of one value of a column; empty: inferred
  // (data/recordings.h).
  std::string recording;
  Missing missing = Missing::error;
  std::map<std::string, RoleWish> roles; // by the column's name; override the inferred roles
  UsedRows rows = UsedRows::sliding;
  ForceZero force_zero = ForceZero::automatic;
  std::vector<std::string> allow_implausible; // names of checks (data/plausibility.h)
  std::vector<FileRule> files;
  std::string tests;       // a file with one row per experiment
  std::string tests_sheet; // if that file is a workbook
  Place tests_place, fill_down_place;
  JoinOptions join;
  std::vector<std::string> above; // conditions above the rows to keep (data/above.h)
  // A regular expression for columns that are one test each (data/wide.h).
  std::string wide;
  Place wide_place;
  // Other columns to keep; absent: all.
  std::optional<std::vector<std::string>> bystanders;
  // Blocks per experiment if rows are condensed to block means (data/condense.h): a number; 0: rows
  // stay in memory; none: usual_blocks above many_rows.
  AutoNumber condense;
  std::string base; // base directory of relative paths
  Place place;      // of [data] or of data.training
  Place oracle_place;
};

// The keys of [data], and what a caller wants beyond them.
struct ReadRequest : DataOptions {
  // True if a law of the job uses this recorded column: Missing::drop then leaves out rows without
  // it.
  std::function<bool(const std::string& column)> needed;
  // false: rows to predict. They need neither a measured stress nor the columns it is computed from
  // (NaN for an empty cell), and an experiment may be one row.
  bool measured = true;
  // The canonical columns. Files of a simulation have others than those of tests.
  std::span<const Quantity> quantities = data::quantities();
  // Size of a piece, for a file that is read in pieces.
  std::size_t piece_bytes = std::size_t{4} << 20;

  ReadRequest(DataOptions options = {}) : DataOptions(std::move(options)) {}
  const Quantity* find_quantity(std::string_view name) const; // nullptr if it is not among these
};

// A request while it is carried out, with what the files have shown so far.
struct Reading : ReadRequest {
  bool keep_spikes = false;             // too many to be single bad readings
  std::set<std::string> columns_beside; // columns of data.tests and data.join

  Reading(ReadRequest request = {}) : ReadRequest(std::move(request)) {}
};

// Column that gives the origin of rows. It is always read and kept, even if data.bystanders does
// not name it, so that synthetic data stay marked.
inline constexpr const char* origin_column = "origin";

// Prefix of the column in DataOptions::experiment if file and column together name a test.
inline constexpr std::string_view file_and_column = "file+";

// DataOptions::experiment of files whose columns come again, side by side, for each test.
inline constexpr std::string_view by_columns = "columns";

// DataOptions::experiment of files that are cut at pauses.
inline constexpr std::string_view by_pauses = "pause";

// True if experiments are counted within the file, which is then read as a whole.
inline bool is_cut_whole(const DataOptions& options) {
  return options.experiment == "interval" || options.experiment == "row" ||
         options.experiment == by_pauses;
}

// The column that DataOptions::experiment names; empty if it names none.
inline std::string experiment_column_of(const DataOptions& options) {
  const std::string& said = options.experiment;
  if (said == "file" || said == "interval" || said == "row" || said == by_pauses) return "";
  if (said == by_columns) return "experiment"; // data/wide.h makes it
  return said.starts_with(file_and_column) ? said.substr(file_and_column.size()) : said;
}

} // namespace frictab::data
