// Guesses how files are to be read: dialect, header, units, and which column is which quantity.
// Every guess is shown to the user before it is used (job/guessed_job.h).
#pragma once

#include <string>
#include <vector>

namespace frictab::data {

struct GuessedColumn {
  std::string name;         // in the file
  std::string unit;         // as the file says; empty: it says none
  std::string canonical;    // a quantity, or experiment; empty: neither
  bool coefficient = false; // of friction: tau_R_MPa is this times sigma_n_MPa
  bool text = false;
  std::string first_values; // "812.3, 813.1, 815"
};

struct GuessedFile {
  std::string file;
  char delimiter = 0; // 0: frictab finds it itself
  char decimal = '.';
  char thousands = 0;
  bool any_decimal = false;  // whole numbers alone: either sign reads them
  std::size_t skip_rows = 0; // 0 also where the header line is found by its names
  bool units_row = false;
  bool intervals = false; // the header line comes again
  bool rows = false;      // each looks like a test (data/checks.h)
  std::vector<GuessedColumn> columns;

  const GuessedColumn* find(const std::string& canonical) const; // nullptr where there is none
  // Whether the keys that read the other one read this one as well.
  bool is_read_as(const GuessedFile& other) const;
};

// A part of all files' names that differs between them.
struct NamePart {
  std::string group;  // what the named group is called
  std::string values; // "20, 50, 100": some of them
};
struct GuessedNames {
  std::string pattern; // a regular expression with named groups; empty: nothing to be found
  std::vector<NamePart> parts;
};

// From the first 64 KiB of a text file (or sheet), or from all of an HDF5 file. Throws InputError
// where it cannot be read as a table.
GuessedFile guess_file(const std::string& path, const std::string& named);

// Folders that differ, and parts of the files' own names between _ - and blanks: numbers in front
// of a unit, and texts that come in at least two files; a text that differs in all files names the
// test.
GuessedNames guess_names(const std::vector<std::string>& files);

} // namespace frictab::data
