// Texts as rigs encode them.
#pragma once

#include <string>

namespace frictab::test {

// Of ASCII: little-endian, with its mark.
inline std::string utf16(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char c : text) {
    wide += c;
    wide += '\0';
  }
  return wide;
}

} // namespace frictab::test
