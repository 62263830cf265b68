// Width of a name column in terminal tables.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/text.h"

namespace frictab {

// Width of the longest name plus one blank; at least `least`.
inline std::size_t column_width(const std::vector<std::string>& names, std::size_t least = 14) {
  std::size_t width = least;
  for (const std::string& name : names)
    width = std::max(width, characters(name) + 1);
  return width;
}

} // namespace frictab
