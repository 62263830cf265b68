// Compares the answers of a routine with the reference.
#pragma once

#include <cmath>

namespace frictab::verify {

// Answer that a driver leaves for a row that its arguments cannot represent; tau_R itself is never
// negative.
inline constexpr double not_representable = -1;

// Returns |a - b| in MPa; 0 if both are NaN, infinite if one is.
inline double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? HUGE_VAL : d;
}

} // namespace frictab::verify
