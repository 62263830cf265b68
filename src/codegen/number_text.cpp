// Writes the shortest text of a double, as in C and as in Fortran, and lines of limited width.
#include "codegen/number_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::codegen {

std::string c_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string fortran_number(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text + (text.find('.') == std::string::npos ? ".0D0" : "D0");
  std::string mantissa = text.substr(0, e), exponent = text.substr(e + 1);
  if (mantissa.find('.') == std::string::npos) mantissa += ".0";
  if (exponent[0] == '+') exponent.erase(0, 1);
  return mantissa + "D" + exponent;
}

std::string number_lines(const std::vector<std::string>& items, std::size_t width,
                         const std::string& indent) {
  std::string out, line = indent;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? "," : "");
    const bool first = line.size() == indent.size();
    if (!first && line.size() + 1 + item.size() > width) {
      out += line + "\n";
      line = indent + item;
    } else {
      line += (first ? "" : " ") + item;
    }
  }
  return out + line;
}

std::vector<std::string> wrap_text(std::string_view text, std::size_t width,
                                   std::string_view further) {
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    std::string word(text.substr(i, end - i));
    while (word.size() > width) { // a formula without blanks
      if (!lines.back().empty()) lines.emplace_back();
      lines.back() = utf8_start(word, width);
      word.erase(0, lines.back().size());
    }
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width)
      lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    i = end + 1;
  }
  for (std::size_t i = 1; i < lines.size(); ++i)
    lines[i].insert(0, further);
  return lines;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t at = 0; at < text.size(); at += lines.back().size() + 1)
    lines.push_back(text.substr(at, text.find('\n', at) - at));
  return lines;
}

} // namespace frictab::codegen
