// Numerical definition of each operation of a formula, used both for constant folding and for
// evaluation.
#pragma once

#include <cmath>
#include <limits>

#include "expr/expr.h"
#include "expr/hyperbolic_tangent.h"

namespace frictab::expr {

// Computes the comparison separately, so that it compiles to an instruction instead of a branch.
inline double min_nan(double a, double b) {
  const double least = b < a ? b : a;
  return std::isnan(b) ? b : least;
}
inline double max_nan(double a, double b) {
  const double most = b > a ? b : a;
  return std::isnan(b) ? b : most;
}

inline double apply(Op op, double a, double b, double c, double d) {
  switch (op) {
  case Op::negate:
    return -a;
  case Op::add:
    return a + b;
  case Op::subtract:
    return a - b;
  case Op::multiply:
    return a * b;
  case Op::divide:
    return a / b;
  case Op::power:
    return std::pow(a, b);
  case Op::exp:
    return std::exp(a);
  case Op::log:
    return std::log(a);
  case Op::sqrt:
    return std::sqrt(a);
  case Op::sin:
    return std::sin(a);
  case Op::tanh:
    return hyperbolic_tangent(a);
  case Op::acos:
    return std::acos(a);
  case Op::minimum:
    return min_nan(a, b);
  case Op::maximum:
    return max_nan(a, b);
  case Op::where_le:
    if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::quiet_NaN();
    return a <= b ? c : d;
  case Op::constant:
  case Op::symbol:
    break;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace frictab::expr
