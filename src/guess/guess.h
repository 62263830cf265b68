// Guesses how files are to be read: dialect, header, units, and the quantity of each column. Every
// guess is shown to the user before it is used (job/guessed_job.h).
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace frictab::guess {

struct Column {
  std::string name;          // in the file
  std::size_t number = 0;    // from 1, where the name does not find the column; else 0
  std::string unit;          // as given in the file; else empty
  std::string answered_unit; // as the user answered; else empty
  std::string canonical;     // a quantity, or experiment; else empty
  bool coefficient = false;  // of friction: tau_R_MPa is this times sigma_n_MPa
  bool text = false;
  bool clock = false;          // texts that are times of day, or dates with them
  bool above = false;          // a condition above the rows (data/above.h)
  bool counts_rows = false;    // above the rows: the number of rows of its file
  bool beside_contact = false; // a temperature that its name gives to another body or time
  double least = 0;            // of its numbers
  bool as_small = false;       // numbers between 0.01 and 1, as coefficients of friction are
  std::string first_values;    // "812.3, 813.1, 815"
  std::size_t empty_below = 0; // empty cells below filled ones, where these may have been merged
  // The cells of a column that may name tests, as texts, if all of them differ.
  std::vector<std::string> names;
  std::vector<std::string> tests; // in rows with several tests: their names, the first ones
};

// A formula that columns give, or an answer.
struct Formula {
  std::string text, comment;
  bool empty() const { return text.empty(); }
};

// A file, or one sheet of a workbook.
struct File {
  std::string file;
  std::string sheet;               // empty: a file without sheets, or with one
  std::vector<std::string> passed; // sheets of the workbook without a table
  char delimiter = 0;              // 0: frictab detects it
  char decimal = '.';
  char thousands = 0;
  bool any_decimal = false; // only whole numbers, which either sign reads
  bool own_decimal = false; // the format of the file has its sign
  double grouped = 0;       // a number whose point may stand between groups of digits; 0: none
  std::size_t skip_footer = 0;
  std::size_t skip_rows = 0; // 0 also if the names identify the header line
  bool units_row = false;
  bool header = true;          // false: columns are named column_1, column_2, ...
  std::size_t header_rows = 1; // lines of names
  bool intervals = false;      // the header line is repeated
  bool phases = false;         // parts of very different length: of one test each?
  bool rows = false;           // each looks like a test (data/checks.h)
  std::string titles;          // pattern of lines of one text in front of parts of the rows
  bool side_by_side = false;   // the same columns come again for each test
  // Columns that seem to be friction of a test each, and a regular expression for them.
  std::vector<std::string> wide;
  std::string wide_pattern;
  bool wide_known = false;          // a table of tests has these names
  std::vector<std::string> missing; // numbers that seem to stand for no value: "-9999"
  std::vector<Column> columns;
  std::size_t row_count = 0; // of all lines below the header
  double area_mm2 = 0;       // of contact, given above the header; 0: none
  // Radius of a body in contact, by a length above the rows; 0: none.
  double radius_mm = 0, inner_radius_mm = 0;
  std::string pressure; // formula of the normal stress, from a force and the area of contact
  Formula friction;     // force, from a torque or a voltage
  Formula speed;        // of sliding, from a speed of rotation
  std::set<std::size_t>
      rows_seen; // a number for the data::quantities of each row, equal for equal rows

  const Column* find(const std::string& canonical) const; // nullptr if there is none
  // True if the keys that read the other file read this one as well.
  bool is_read_as(const File& other) const;
  std::string label() const; // the name of the test, if the file is one
};

// A part of all files' names that differs between them.
struct NamePart {
  std::string group;  // name of its group
  std::string values; // "20, 50, 100": some of them
};
struct NamePattern {
  // A regular expression with named groups; empty: no pattern found.
  std::string pattern;
  std::vector<NamePart> parts;
};

// Guesses from the first 64 KiB of a text file (or sheet), or from all of an HDF5 file
// or one of data/rig_files.h. One guess
// per file, and per sheet of a workbook that is a table. Throws InputError if there is none.
std::vector<File> guess_file(const std::string& path, const std::string& named);

// A file that is not proposed for reading.
struct LeftFile {
  std::string file;
  std::string why; // "it has no column for time_s, which most files have"
  bool may_list_tests = false;
};

struct Campaign {
  std::vector<File> files;   // rows of tests
  std::optional<File> tests; // one row per test: its column experiment has their labels
  // Sheets of one workbook, or equal for all of them: names or "*"; empty: no choice is needed.
  std::vector<std::string> sheets;
  std::vector<std::string> passed;              // names of sheets that are not read
  std::vector<LeftFile> left = {};              // tables of something else, older versions
  std::map<std::string, double> constants = {}; // by canonical name, as the user answered
};

// Index of the file that most files are read like; of equals, the first with a clock and friction.
std::size_t most_common(const std::vector<File>& files);

// Sorts guesses: the table of tests is found by a column whose texts are the labels of at least
// half of the others, or have their numbers; files without the clock or the friction that most
// files have are left, and so are older versions of a file; sheets of a workbook that are read in
// another way than most are passed.
Campaign sort_guesses(std::vector<File> guesses);

// Finds folders that differ, and parts of the files' own names between _ - and blanks: numbers
// before a unit, and texts that occur in at least two files; a text that differs in all files names
// the test.
NamePattern guess_names(const std::vector<std::string>& files);

} // namespace frictab::guess
