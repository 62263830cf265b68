// Numbers and lines of generated text: numbers that a compiler reads back to the same bits; lists
// and sentences broken into lines.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace frictab::codegen {

// Formats with at most 17 significant digits, which read back to the same bits. C: 1.0, 1e-20.
// Fortran: 1.0D0.
std::string c_number(double value);
std::string fortran_number(double value);

// Joins items with commas, broken into lines of at most `width` columns that start with `indent`.
std::string number_lines(const std::vector<std::string>& items, std::size_t width,
                         const std::string& indent);

// Lists numbers as C and Lua write them, in lines of at most 98 columns.
template <class Numbers> std::string number_block(const Numbers& numbers, std::size_t indent = 4) {
  std::vector<std::string> texts;
  for (const auto number : numbers)
    if constexpr (std::is_integral_v<std::remove_const_t<decltype(number)>>)
      texts.push_back(std::to_string(number));
    else
      texts.push_back(c_number(number));
  return number_lines(texts, 98, std::string(indent, ' '));
}

// Breaks text at blanks into lines of at most `width` columns. All but the first begin with
// `further`, which does not count.
std::vector<std::string> wrap_text(std::string_view text, std::size_t width,
                                   std::string_view further = {});

// Returns the lines of a text, without their breaks.
std::vector<std::string_view> lines_of(std::string_view text);

} // namespace frictab::codegen
