// Interval arithmetic (Moore 1966): from the interval of each operand, an interval that contains
// the result for all operands in their intervals. Ends are rounded outwards, so the result includes
// rounding errors. It is rigorous but pessimistic: x - x over 0 .. 1 gives -1 .. 1, because the
// dependence of both operands on the same x is lost (taylor_model.h keeps it).
#pragma once

#include <algorithm>
#include <cmath>

#include "expr/expr.h"

namespace frictab::expr {

struct Bounds {
  double low = 0;
  double high = 0;

  double magnitude() const { return std::max(std::abs(low), std::abs(high)); }
  double width() const { return high - low; }
  bool finite() const { return std::isfinite(low) && std::isfinite(high); }
};

// The interval of all numbers: nothing is known.
inline constexpr Bounds whole_line{-HUGE_VAL, HUGE_VAL};

// Widens by a few units in the last place, more than the error of the mathematical library. An
// interval with a NaN end becomes the whole line.
Bounds outward(double low, double high);

Bounds hull(const Bounds& a, const Bounds& b);
Bounds operator+(const Bounds& a, const Bounds& b);
Bounds operator-(const Bounds& a, const Bounds& b);
Bounds operator*(const Bounds& a, const Bounds& b);
Bounds operator/(const Bounds& a, const Bounds& b); // whole line if b contains 0

// Applies the operation to intervals. where_le with an undecided condition gives the hull of both
// branches. Outside the domain (logarithm of a negative number, ...) the result is the whole line.
Bounds apply(Op op, const Bounds& a, const Bounds& b, const Bounds& c, const Bounds& d);

} // namespace frictab::expr
