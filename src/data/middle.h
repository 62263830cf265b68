// Order statistics of a few thousand numbers. Values have to be finite.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/no_value.h"

namespace frictab::data {

// 0 for none.
inline double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at = std::lround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

// Of an even number the mean of both in the middle, so that -median(x) is median(-x).
inline double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

// Of an even number the upper one in the middle, so that it is a value that is there; NaN of none.
inline double upper_median(std::vector<double> values) {
  if (values.empty()) return no_value;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

} // namespace frictab::data
