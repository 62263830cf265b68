// Reads decimal numbers anywhere in a text, with a decimal point or a decimal comma.
#pragma once

#include <string_view>

namespace frictab::io {

// Reads the number that starts at `begin`: [+-]digits[.digits][e[+-]digits], where '.' is `decimal`
// ("1800," and ".5" are numbers, and Fortran's d is accepted for e). The value is the nearest
// double. Returns the end of the number, or nullptr if there is none or it is too large for a
// double.
const char* scan_number(const char* begin, const char* end, char decimal, double& value);

// True if the whole text is one number.
bool read_number(std::string_view text, char decimal, double& value);

// Reads a whole text whose digits are in groups of three: 1.234.567,8 with '.' between them, or '
// (also U+2019), or a blank (also U+00A0 and U+202F). Every group must be complete.
bool read_grouped_number(std::string_view text, char decimal, char between, double& value);

} // namespace frictab::io
