// Names of interaction and surfaces as Abaqus hands them to a routine.
#pragma once

#include <string>

namespace frictab::calls {

// Padded with blanks to 80 characters.
inline std::string name80(std::string text) {
  text.resize(80, ' ');
  return text;
}

} // namespace frictab::calls
