// A handed-on file that differs from what it was made from.
#pragma once

#include <string>

namespace frictab::verify {

// One difference in one file.
struct Finding {
  std::string model;  // name of the law; empty: of no single one
  std::string file;   // "out/tables/coulomb.h5"; of a text with its line: "out/export/c/x.c:12"
  std::string where;  // "outside_low of sigma_n_MPa", "compile[2]"; empty: the whole file
  std::string what;   // "is 'clamp', made as 'law'"
  std::string mend;   // how to make the file again
  bool failed = true; // false: a note; what the file says is right

  bool operator==(const Finding&) const = default;

  // "out/tables/coulomb.h5: outside_low of sigma_n_MPa is 'clamp', made as 'law'"
  std::string text() const { return file + ": " + (where.empty() ? "" : where + " ") + what; }
};

} // namespace frictab::verify
