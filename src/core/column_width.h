// Tables on the terminal: a column of names is as wide as its longest name.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "core/text.h"

namespace frictab {

// With a blank behind the longest; at least `least`.
inline std::size_t column_width(const std::vector<std::string>& names, std::size_t least = 14) {
  std::size_t width = least;
  for (const std::string& name : names)
    width = std::max(width, characters(name) + 1);
  return width;
}

} // namespace frictab
