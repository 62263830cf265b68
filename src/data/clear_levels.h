// Levels at which tests were run, from values with scatter: 50.3, 49.8 and 99.6 are two.
#pragma once

#include <cstddef>
#include <vector>

namespace frictab::data {

struct ClearLevels {
  std::vector<std::size_t> of; // level of each value, ascending; empty: there are no clear levels
  std::size_t count = 0;
  double width = 0; // of the widest level
};

// Levels are clear if each is at most a quarter as wide as the narrowest gap between two, and holds
// two values on average. Values within `same` of each other are one level. They must be finite.
ClearLevels clear_levels(const std::vector<double>& values, double same);

} // namespace frictab::data
