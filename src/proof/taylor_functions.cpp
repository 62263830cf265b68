// Chebyshev interpolation with an error bound from each function's derivatives.
#include "proof/taylor_functions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "expr/arithmetic.h"

namespace frictab::proof {

using expr::Op;

namespace {

using std::numbers::pi;

// Distance of 0 from the interval low .. high.
double distance_from_zero(double low, double high) {
  if (low > 0) return low;
  return high < 0 ? -high : 0;
}

double value_of(Op op, double x) {
  return op == Op::divide ? 1 / x : expr::apply(op, x, 0, 0, 0);
}

double whole_power(double x, std::size_t n) {
  double out = 1;
  for (; n > 0; --n)
    out *= x;
  return out;
}

// |d^n tanh / n!| over low .. high, n >= 1, from its poles at (k - 1/2) pi i: each pair
// contributes at most 2 |x - pole|^-(n+1).
double tanh_derivative(double low, double high, std::size_t n) {
  const double x = distance_from_zero(low, high);
  double sum = 0;
  constexpr int pairs = 4;
  for (int k = 0; k < pairs; ++k) {
    const double y = (k + 0.5) * pi;
    sum += 2 * whole_power(1 / std::sqrt(x * x + y * y), n + 1);
  }
  // Bounds the rest of the sum by the integral from its last term on.
  const double y = (pairs - 0.5) * pi;
  return sum + 2 / pi * whole_power(1 / y, n) / static_cast<double>(n);
}

double factorial(std::size_t n) {
  return n < 2 ? 1 : static_cast<double>(n) * factorial(n - 1);
}

// An upper bound of |f^(n) / n!| over low .. high.
double derivative_bound(Op op, double low, double high, std::size_t n) {
  const auto order = static_cast<double>(n);
  const bool above = low > 0;
  switch (op) {
  case Op::exp:
    return std::exp(high) / factorial(n);
  case Op::log:
    return above ? whole_power(1 / low, n) / order : HUGE_VAL;
  case Op::divide: {
    const double nearest = distance_from_zero(low, high);
    return nearest > 0 ? whole_power(1 / nearest, n + 1) : HUGE_VAL;
  }
  case Op::sqrt: {
    double binomial = 1;
    for (std::size_t k = 0; k < n; ++k)
      binomial *= (0.5 - static_cast<double>(k)) / static_cast<double>(k + 1);
    return above ? std::abs(binomial) * std::pow(low, 0.5 - order) : HUGE_VAL;
  }
  case Op::sin:
    return 1 / factorial(n);
  case Op::tanh:
    return tanh_derivative(low, high, n);
  default:
    return HUGE_VAL;
  }
}

// Chebyshev points, and the matrix that converts values at them to coefficients of powers of y.
struct Interpolation {
  std::vector<double> point;
  std::vector<double> power; // [power][point]
};

Interpolation interpolation(std::size_t n) {
  Interpolation out{std::vector<double>(n), std::vector<double>(n * n, 0.0)};
  const auto count = static_cast<double>(n);
  const auto angle = [&](std::size_t j) { return pi * (static_cast<double>(j) + 0.5) / count; };
  std::vector<double> before(n, 0.0), now(n, 0.0), next(n, 0.0); // T_k-1, T_k, T_k+1 by powers
  now[0] = 1;
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t j = 0; j < n; ++j) {
      out.point[j] = std::cos(angle(j));
      const double share = (k == 0 ? 1 : 2) / count * std::cos(static_cast<double>(k) * angle(j));
      for (std::size_t i = 0; i < n; ++i)
        out.power[i * n + j] += share * now[i];
    }
    const int twice = k == 0 ? 1 : 2; // T_k+1 = 2 y T_k - T_k-1, except T_1 = y T_0
    for (std::size_t i = 0; i < n; ++i)
      next[i] = (i > 0 ? twice * now[i - 1] : 0) - before[i];
    before.swap(now);
    now.swap(next);
  }
  return out;
}

constexpr std::size_t most_powers = 10;

const Interpolation& interpolation_of(std::size_t n) {
  static const std::vector<Interpolation> all = [] {
    std::vector<Interpolation> list(1);
    for (std::size_t k = 1; k <= most_powers; ++k)
      list.push_back(interpolation(k));
    return list;
  }();
  return all[n];
}

} // namespace

double chebyshev_fit(Op op, double centre, double radius, std::span<double> c) {
  const std::size_t n = c.size();
  // Extends the interval slightly beyond its ends, because centre and radius are rounded
  // themselves.
  const double slack = 4 * std::numeric_limits<double>::epsilon() * (std::abs(centre) + radius);
  const double low = centre - radius - slack, high = centre + radius + slack;
  const double bound = derivative_bound(op, low, high, n);
  if (!std::isfinite(bound) || !std::isfinite(low) || !std::isfinite(high)) return HUGE_VAL;
  const Interpolation& at = interpolation_of(n);
  double f[most_powers], largest = 0;
  for (std::size_t j = 0; j < n; ++j) {
    f[j] = value_of(op, centre + radius * at.point[j]);
    largest = std::max(largest, std::abs(f[j]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = 0;
    for (std::size_t j = 0; j < n; ++j)
      c[i] += at.power[i * n + j] * f[j];
  }
  const auto count = static_cast<double>(n);
  const double truncation =
      bound * std::ldexp(whole_power(radius + slack, n), 1 - static_cast<int>(n));
  const double slope = derivative_bound(op, low, high, 1) * slack;
  const double rounding = std::ldexp(16.0, static_cast<int>(n)) * count *
                          std::numeric_limits<double>::epsilon() * largest;
  return truncation * (1 + 1e-9) + rounding + slope;
}

} // namespace frictab::proof
