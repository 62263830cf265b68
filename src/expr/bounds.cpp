// Interval arithmetic for the operations of a formula.
#include "expr/bounds.h"

#include <limits>

namespace frictab::expr {

namespace {

constexpr double ulps = 8 * std::numeric_limits<double>::epsilon();
constexpr double tiny = std::numeric_limits<double>::min();
constexpr double largest = std::numeric_limits<double>::max();

// Product of interval ends, with 0 times infinity = 0: an infinite end is never attained.
double product(double a, double b) {
  return a == 0 || b == 0 ? 0 : a * b;
}

Bounds monotone(double (*f)(double), const Bounds& a) {
  return outward(f(a.low), f(a.high));
}

Bounds sine(const Bounds& a) {
  // Without a turning point inside, the extremes are at the ends.
  const double half = std::acos(-1.0);
  const double first = std::ceil(a.low / half - 0.5), last = std::floor(a.high / half - 0.5);
  if (a.width() < 1e6 && a.magnitude() < 1e6 && first > last) {
    const double x = std::sin(a.low), y = std::sin(a.high);
    return outward(std::min(x, y), std::max(x, y));
  }
  return {-1, 1};
}

Bounds power(const Bounds& a, const Bounds& b) {
  if (a.low <= 0) return whole_line;
  return apply(Op::exp, b * apply(Op::log, a, {}, {}, {}), {}, {}, {});
}

} // namespace

Bounds outward(double low, double high) {
  if (std::isnan(low) || std::isnan(high)) return whole_line;
  // Limits the ends to finite numbers: an infinite lower end minus a part of itself would be NaN.
  low = std::min(low, largest);
  high = std::max(high, -largest);
  return {low - ulps * std::abs(low) - tiny, high + ulps * std::abs(high) + tiny};
}

Bounds hull(const Bounds& a, const Bounds& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

Bounds operator+(const Bounds& a, const Bounds& b) {
  return outward(a.low + b.low, a.high + b.high);
}
Bounds operator-(const Bounds& a, const Bounds& b) {
  return outward(a.low - b.high, a.high - b.low);
}
Bounds operator*(const Bounds& a, const Bounds& b) {
  const double p = product(a.low, b.low), q = product(a.low, b.high);
  const double r = product(a.high, b.low), s = product(a.high, b.high);
  return outward(std::min({p, q, r, s}), std::max({p, q, r, s}));
}
Bounds operator/(const Bounds& a, const Bounds& b) {
  if (b.low <= 0 && b.high >= 0) return whole_line;
  return a * outward(1 / b.high, 1 / b.low);
}

Bounds apply(Op op, const Bounds& a, const Bounds& b, const Bounds& c, const Bounds& d) {
  switch (op) {
  case Op::negate:
    return {-a.high, -a.low};
  case Op::add:
    return a + b;
  case Op::subtract:
    return a - b;
  case Op::multiply:
    return a * b;
  case Op::divide:
    return a / b;
  case Op::power:
    return power(a, b);
  case Op::exp:
    return monotone([](double x) { return std::exp(x); }, a);
  case Op::log:
    return a.low <= 0 ? whole_line : monotone([](double x) { return std::log(x); }, a);
  case Op::sqrt:
    return a.low < 0 ? whole_line : monotone([](double x) { return std::sqrt(x); }, a);
  case Op::sin:
    return sine(a);
  case Op::tanh:
    return monotone([](double x) { return std::tanh(x); }, a);
  case Op::acos:
    return a.low < -1 || a.high > 1 ? whole_line : outward(std::acos(a.high), std::acos(a.low));
  case Op::minimum:
    return {std::min(a.low, b.low), std::min(a.high, b.high)};
  case Op::maximum:
    return {std::max(a.low, b.low), std::max(a.high, b.high)};
  case Op::where_le:
    if (a.high <= b.low) return c;
    return b.high < a.low ? d : hull(c, d);
  case Op::constant:
  case Op::symbol:
    break;
  }
  return whole_line;
}

} // namespace frictab::expr
