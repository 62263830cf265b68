// What a routine answered against what it should have.
#pragma once

#include <cmath>

namespace frictab::verify {

// What a driver leaves where its solver can never be: tau_R is not negative.
inline constexpr double not_posed = -1;

// |a - b| in MPa; 0 where both are NaN, infinite where one is.
inline double difference(double a, double b) {
  if (std::isnan(a) && std::isnan(b)) return 0;
  const double d = std::abs(a - b);
  return std::isnan(d) ? HUGE_VAL : d;
}

} // namespace frictab::verify
