// Makes text of users safe for HTML, XML and SVG.
#include "report/svg.h"

#include "core/text.h"

namespace frictab::report::svg {

namespace {

// XML excludes U+FFFE, U+FFFF and control characters.
bool is_character(std::string_view one) {
  const auto first = static_cast<unsigned char>(one.front());
  if (one.size() == 3 && one.substr(0, 2) == "\xEF\xBF")
    return static_cast<unsigned char>(one[2]) < 0xBE;
  return first >= 0x20 || one == "\t" || one == "\n";
}

} // namespace

std::string escape(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    const char c = text[i];
    if (length == 0 || !is_character(text.substr(i, length)))
      out += "\xEF\xBF\xBD";
    else if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'')
      out += "&#39;";
    else
      out += text.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return out;
}

} // namespace frictab::report::svg
