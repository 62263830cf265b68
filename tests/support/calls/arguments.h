// What the argument lists of several routines share.
#pragma once

#include <cstddef>
#include <string>

namespace frictab::calls {

// Names of interaction and surfaces as Abaqus hands them over: padded with blanks to 80 characters.
inline std::string name80(std::string text) {
  text.resize(80, ' ');
  return text;
}

// Elements of an array.
inline std::size_t size(int a, int b = 1, int c = 1) {
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
}

} // namespace frictab::calls
