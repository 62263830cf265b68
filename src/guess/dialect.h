// Dialect of a text: delimiter, signs in numbers, lines of names and units.
#pragma once

#include <string>
#include <string_view>

#include "io/csv.h"

namespace frictab::guess {

struct Dialect {
  io::CsvFormat format;
  io::CsvTable table;       // as the format reads it
  bool any_decimal = false; // only whole numbers, so either decimal sign works
  double grouped = 0;       // a number whose point may stand between groups of digits; 0: none
};

// `workbook`: the text is a sheet, with points and commas. Throws InputError if no dialect makes a
// table of numbers of it.
Dialect find_dialect(std::string_view text, const std::string& named, bool workbook);

} // namespace frictab::guess
