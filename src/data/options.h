// [data] of a job: which files, and how their columns become canonical ones.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"

namespace frictab::data {

// How one canonical column is taken from a file.
struct ColumnSource {
  std::vector<std::string> names; // the file's own name; several = the first one present
  std::size_t number = 0;         // or the column's number in the file, from 1
  std::string unit;               // the file's unit; empty = canonical
  std::string times;              // a measured coefficient: multiplied with this canonical column
  double area_mm2 = 0;            // a force over this nominal area gives a stress
  std::size_t slope_rows = 0;     // |d column/d time| by a least-squares line over this many rows
  std::string formula;            // or computed from other columns (data/computed.h)
  Place place;
};

struct DropRule {
  std::string column; // canonical
  std::optional<double> below;
  std::optional<double> above;
  Place place;
};

// An empty cell of a quantity: a fault, or its row is left out and counted.
enum class Missing { error, drop };

// Which rows are fitted (data/phases.h).
enum class UsedRows { sliding, all };

// What the forces of both directions of a test differ by (data/signs.h): decided by how it goes
// with the load; the zero of the force cell, taken off; friction, kept.
enum class ForceZero { automatic, remove, keep };

// What is special about some files; the first rule that matches a file counts. What it leaves out
// is as for all.
struct FileRule {
  std::string match; // a glob; of the whole name where it holds a /
  std::optional<char> delimiter, decimal, thousands;
  std::optional<std::size_t> skip_rows, skip_footer;
  std::optional<bool> units_row;
  std::string sheet; // of a workbook
  std::map<std::string, ColumnSource> columns;
  std::map<std::string, double> constants;   // canonical, or a column of its own
  std::map<std::string, std::string> labels; // text columns
  std::string from_name;                     // a regular expression with named groups
  std::string experiment;
  Place place, from_name_place;
};

// What the job says that a recorded column is.
struct RoleWish {
  Role role = Role::undecided;
  Place place;
};

// A number, or "auto".
struct AutoNumber {
  std::optional<double> value;
};

// [data.join]: other files of the same tests with a clock of their own (data/join.h).
struct JoinOptions {
  std::vector<std::string> files; // empty: none
  std::string by = "time_s";      // or s_mm
  AutoNumber offset;              // what is added to their clock
  FileRule how;                   // they are read; its match is all of them
  Place place;
};

struct DataOptions {
  std::vector<std::string> training;
  std::vector<std::string> validation; // empty: some experiments are held out, or each in turn
  std::vector<std::string> oracle;     // synthetic data: files of the noise-free stress
  std::optional<double> holdout;       // share of EXPERIMENTS; absent: by their number
  char delimiter = 0;                  // 0: found from the header line (, ; tab | or blanks)
  char decimal = '.';
  char thousands = 0;          // between groups of three digits; 0: nothing
  std::size_t skip_rows = 0;   // preamble lines before the header
  std::size_t skip_footer = 0; // lines after the data
  bool units_row = false;      // a line of units below the header
  std::string sheet;           // of a workbook; empty: the first one
  std::vector<DropRule> drop;
  std::map<std::string, ColumnSource> columns; // by canonical name
  std::map<std::string, double> constants;     // by canonical name; of one file others as well
  std::map<std::string, std::string> labels;   // of one file: text columns
  // What an experiment is: "file", "interval" (from one header line to the next), "row", a column,
  // or "file+COLUMN"; empty: a column of the name experiment where there is one, else the file.
  std::string experiment;
  // Which experiments are intervals of one recording: "none", those of a "file", those whose "name"
  // differs in its last number, or those of one value of a column; empty: inferred
  // (data/recordings.h).
  std::string recording;
  Missing missing = Missing::error;
  // Whether a law of the job takes this recorded column: Missing::drop leaves out rows without it.
  std::function<bool(const std::string& column)> needed;
  // false: rows to predict. They need neither a measured stress nor what it is computed from (NaN
  // where a cell of it is empty), and an experiment may be one row.
  bool measured = true;
  std::map<std::string, RoleWish> roles; // by the column's name: overrule what is inferred
  UsedRows rows = UsedRows::sliding;
  ForceZero force_zero = ForceZero::automatic;
  bool keep_spikes = false;                   // too many to be single bad readings; no job key
  std::vector<std::string> allow_implausible; // names of checks (data/plausibility.h)
  std::vector<FileRule> files;
  std::string tests; // a file with one row per experiment
  Place tests_place;
  JoinOptions join;
  std::string wide; // a regular expression: which columns are one test each (data/wide.h)
  Place wide_place;
  std::optional<std::vector<std::string>> bystanders; // other columns to keep; absent: all
  std::set<std::string> columns_beside; // of `tests` and `join`, once they are read; no job key
  // Blocks of an experiment where rows are held as means over blocks (data/condense.h): a number, 0
  // = rows are held; none: usual_blocks above many_rows.
  AutoNumber condense;
  std::size_t piece_bytes = std::size_t{4} << 20; // of a file that is read in pieces; no job key
  std::string base;                               // directory that relative paths start from
  Place place;                                    // of [data] or of data.training
  Place oracle_place;
};

// Says where rows come from. Read and kept whatever data.bystanders names: what is synthetic stays
// so.
inline constexpr const char* origin_column = "origin";

// In front of the column in DataOptions::experiment where both name a test.
inline constexpr std::string_view file_and_column = "file+";

// Whether experiments are counted in the file: it is read as a whole.
inline bool is_cut_whole(const DataOptions& options) {
  return options.experiment == "interval" || options.experiment == "row";
}

// The column that DataOptions::experiment names; empty where it names none.
inline std::string experiment_column_of(const DataOptions& options) {
  const std::string& said = options.experiment;
  if (said == "file" || said == "interval" || said == "row") return "";
  return said.starts_with(file_and_column) ? said.substr(file_and_column.size()) : said;
}

} // namespace frictab::data
