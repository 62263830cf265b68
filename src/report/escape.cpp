// Text of users made safe for HTML, XML and SVG.
#include "report/svg.h"

namespace frictab::svg {

namespace {

// Length of the well-formed UTF-8 sequence at the front (RFC 3629), 0 where there is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned a = byte(0), b = byte(1);
  if (a < 0x80) return 1;
  if (a >= 0xC2 && a <= 0xDF) return follows(1) ? 2 : 0;
  const bool overlong = (a == 0xE0 && b < 0xA0) || (a == 0xF0 && b < 0x90);
  const bool surrogate_or_beyond = (a == 0xED && b >= 0xA0) || (a == 0xF4 && b >= 0x90);
  if (overlong || surrogate_or_beyond) return 0;
  // U+FFFE and U+FFFF are no characters of XML.
  if (a == 0xEF && b == 0xBF && byte(2) >= 0xBE) return 0;
  if (a >= 0xE0 && a <= 0xEF) return follows(1) && follows(2) ? 3 : 0;
  if (a >= 0xF0 && a <= 0xF4) return follows(1) && follows(2) && follows(3) ? 4 : 0;
  return 0;
}

} // namespace

std::string escape(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text.substr(i));
    const char c = text[i];
    const bool control = static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n';
    if (length == 0 || control)
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

} // namespace frictab::svg
