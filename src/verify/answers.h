// What a routine answered against what it should have.
#pragma once

#include <cmath>

namespace frictab::verify {

// The answer that a driver leaves for a row that its arguments cannot represent: tau_R is not
// negative.
inline constexpr double not_representable = -1;

// |a - b| in MPa; 0 where both are NaN, infinite where one is.
inline double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? HUGE_VAL : d;
}

} // namespace frictab::verify
