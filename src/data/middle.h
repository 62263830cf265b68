// Order statistics of a few thousand numbers, which must be finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/no_value.h"

namespace frictab::data {

// Returns 0 for no values.
inline double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

// Averages the two middle values of an even number of values, so that median(-x) = -median(x).
inline double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

// Takes the upper middle value of an even number of values, so that the result is one of them; NaN
// for no values.
inline double upper_median(std::vector<double> values) {
  if (values.empty()) return no_value;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace frictab::data
