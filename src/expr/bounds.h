// Interval arithmetic (Moore 1966): from the interval of each operand, an interval that certainly
// holds the result, whatever values the operands take in theirs. Ends are rounded outwards, so that
// not even rounding leaves it. It is rigorous but pessimistic: x - x over 0 .. 1 gives -1 .. 1,
// since it does not know that both are the same x (taylor_model.h does).
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

// Everything: nothing is known.
inline constexpr Bounds whole_line{-HUGE_VAL, HUGE_VAL};

// A few units in the last place wider: more than the mathematical library errs by. An interval with
// a NaN end becomes the whole line.
Bounds outward(double low, double high);

Bounds hull(const Bounds& a, const Bounds& b);
Bounds operator+(const Bounds& a, const Bounds& b);
Bounds operator-(const Bounds& a, const Bounds& b);
Bounds operator*(const Bounds& a, const Bounds& b);
Bounds operator/(const Bounds& a, const Bounds& b); // whole line where b holds 0

// The operation on intervals. where_le with an open condition gives the hull of both branches.
// Outside the domain (logarithm of a negative number, ...): the whole line.
Bounds apply(Op op, const Bounds& a, const Bounds& b, const Bounds& c, const Bounds& d);

} // namespace frictab::expr
