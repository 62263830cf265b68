// Numbers and lines of generated text: numbers that a compiler reads back to the same bits; lists
// and sentences broken into lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace frictab::codegen {

// Formats with at most 17 significant digits, which read back to the same bits. C: 1.0, 1e-20.
// Fortran: 1.0D0.
std::string c_number(double value);
std::string fortran_number(double value);

// Joins items with commas, broken into lines of at most `width` columns that start with `indent`.
std::string number_lines(const std::vector<std::string>& items, std::size_t width,
                         const std::string& indent);

// Breaks text at blanks into lines of at most `width` columns.
std::vector<std::string> wrap_text(std::string_view text, std::size_t width);

} // namespace frictab::codegen
