// Guesses how files are to be read: dialect, header, units, and the quantity of each column. Every
// guess is shown to the user before it is used (job/guessed_job.h).
#pragma once

#include <string>
#include <vector>

namespace frictab::data {

struct GuessedColumn {
  std::string name;         // in the file
  std::string unit;         // as given in the file; else empty
  std::string canonical;    // a quantity, or experiment; else empty
  bool coefficient = false; // of friction: tau_R_MPa is this times sigma_n_MPa
  bool text = false;
  std::string first_values; // "812.3, 813.1, 815"
};

struct GuessedFile {
  std::string file;
  char delimiter = 0; // 0: frictab detects it
  char decimal = '.';
  char thousands = 0;
  bool any_decimal = false;  // only whole numbers, which either sign reads
  std::size_t skip_rows = 0; // 0 also if the names identify the header line
  bool units_row = false;
  bool intervals = false; // the header line is repeated
  bool rows = false;      // each looks like a test (data/checks.h)
  std::vector<GuessedColumn> columns;

  const GuessedColumn* find(const std::string& canonical) const; // nullptr if there is none
  // True if the keys that read the other file read this one as well.
  bool is_read_as(const GuessedFile& other) const;
};

// A part of all files' names that differs between them.
struct NamePart {
  std::string group;  // name of its group
  std::string values; // "20, 50, 100": some of them
};
struct GuessedNames {
  // A regular expression with named groups; empty: no pattern found.
  std::string pattern;
  std::vector<NamePart> parts;
};

// Guesses from the first 64 KiB of a text file (or sheet), or from all of an HDF5 file. Throws
// InputError if it cannot be read as a table.
GuessedFile guess_file(const std::string& path, const std::string& named);

// Finds folders that differ, and parts of the files' own names between _ - and blanks: numbers
// before a unit, and texts that occur in at least two files; a text that differs in all files names
// the test.
GuessedNames guess_names(const std::vector<std::string>& files);

} // namespace frictab::data
