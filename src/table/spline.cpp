// Cell polynomials by the recurrence of B-splines; coefficients by one banded solve per axis.
#include "table/spline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace frictab::table {

namespace {

using Cubic = std::array<double, 4>; // coefficients of the powers of the cell's weight t

// Multiplies p by (a + b t).
Cubic times(const Cubic& p, double a, double b) {
  return {p[0] * a, p[1] * a + p[0] * b, p[2] * a + p[1] * b, p[3] * a + p[2] * b};
}

Cubic sum(const Cubic& p, const Cubic& q) {
  return {p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]};
}

// Returns the degree + 1 B-splines that are not zero between knots[span + degree] and the next
// knot, as polynomials on the cell x = low + width t (Cox - de Boor).
std::array<Cubic, 4> cell_polynomials(const std::vector<double>& knots, std::size_t span,
                                      std::size_t degree, double low, double width) {
  std::array<Cubic, 4> basis{};
  basis[0] = {1, 0, 0, 0};
  for (std::size_t q = 1; q <= degree; ++q)
    for (std::size_t j = q + 1;
         j-- > 0;) { // from the last: each uses its own old value and the one before
      const std::size_t k = span + degree - q + j; // knot where spline j of degree q begins
      Cubic next{};
      if (j > 0) {
        const double length = knots[k + q] - knots[k];
        next = times(basis[j - 1], (low - knots[k]) / length, width / length);
      }
      if (j < q) {
        const double length = knots[k + q + 1] - knots[k + 1];
        next = sum(next, times(basis[j], (knots[k + q + 1] - low) / length, -width / length));
      }
      basis[j] = next;
    }
  return basis;
}

// Adds the cells of nodes begin .. end (one spline) to the axis.
void add_segment(SplineAxis& axis, std::size_t begin, std::size_t end) {
  const std::size_t nodes = end - begin + 1;
  const std::size_t degree = std::min<std::size_t>(3, nodes - 1);
  const std::vector<double>& u = axis.u;
  std::vector<double> knots(degree + 1, u[begin]);
  for (std::size_t i = 2; i + 2 < nodes; ++i)
    knots.push_back(u[begin + i]);
  knots.insert(knots.end(), degree + 1, u[end]);
  const std::size_t last_span = knots.size() - 2 * degree - 2;
  const std::size_t support = std::min<std::size_t>(4, u.size());
  for (std::size_t cell = 0; cell + 1 < nodes; ++cell) {
    const std::size_t span =
        nodes <= 4 ? 0 : std::min(cell - std::min<std::size_t>(cell, 1), last_span);
    const double low = u[begin + cell];
    const auto basis = cell_polynomials(knots, span, degree, low, u[begin + cell + 1] - low);
    // The window of coefficients of a short segment at the end of a longer axis must not pass the
    // end.
    const std::size_t first = std::min(begin + span, u.size() - support);
    const std::size_t shift = begin + span - first;
    axis.first.push_back(static_cast<int>(first));
    const std::size_t at = axis.basis.size();
    axis.basis.resize(at + 16, 0.0);
    for (std::size_t j = 0; j <= degree; ++j)
      for (std::size_t power = 0; power < 4; ++power)
        axis.basis[at + 4 * power + j + shift] = basis[j][power];
  }
}

constexpr std::size_t reach = 3; // half width of the band

// Band matrix: [i][j] is the value at node i of spline i + j - reach.
std::vector<std::array<double, 2 * reach + 1>> collocation(const SplineAxis& axis) {
  const std::size_t n = axis.u.size();
  std::vector<std::array<double, 2 * reach + 1>> band(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t cell = std::min(i, n - 2);
    for (std::size_t j = 0; j < std::min<std::size_t>(4, n); ++j) {
      const double* b = axis.basis.data() + 16 * cell + j;
      const double value = i == cell ? b[0] : b[0] + b[4] + b[8] + b[12];
      const auto column = static_cast<std::size_t>(axis.first[cell]) + j;
      if (column + reach >= i && column <= i + reach) band[i][column + reach - i] = value;
    }
  }
  return band;
}

} // namespace

SplineAxis spline_axis(const std::vector<double>& u, const std::vector<double>& kinks) {
  SplineAxis axis;
  axis.u = u;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < u.size(); ++i)
    if (i + 1 == u.size() || std::ranges::find(kinks, u[i]) != kinks.end()) {
      add_segment(axis, begin, i);
      begin = i;
    }
  return axis;
}

SplineAxis spline_axis(const TableAxis& axis) {
  std::vector<double> kinks = axis.kinks;
  if (axis.log)
    for (double& kink : kinks)
      kink = std::log(kink);
  return spline_axis(axis.coordinates(), kinks);
}

void solve_along(const SplineAxis& axis, std::size_t outer, std::size_t inner,
                 std::span<double> values) {
  const std::size_t n = axis.u.size();
  auto band = collocation(axis);
  std::vector<std::array<double, reach>> lower(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 1; k <= reach && i + k < n; ++k) {
      const double factor = band[i + k][reach - k] / band[i][reach];
      lower[i + k][k - 1] = factor;
      for (std::size_t j = 1; j <= reach; ++j)
        band[i + k][reach + j - k] -= factor * band[i][reach + j];
    }
  for (std::size_t o = 0; o < outer; ++o) {
    double* x = values.data() + o * n * inner;
    const auto subtract = [&](std::size_t to, std::size_t from, double factor) {
      if (factor == 0) return;
      for (std::size_t i = 0; i < inner; ++i)
        x[to * inner + i] -= factor * x[from * inner + i];
    };
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = std::min(i, reach); k > 0; --k)
        subtract(i, i - k, lower[i][k - 1]);
    for (std::size_t i = n; i-- > 0;) {
      for (std::size_t k = 1; k <= reach && i + k < n; ++k)
        subtract(i, i + k, band[i][reach + k]);
      for (std::size_t l = 0; l < inner; ++l)
        x[i * inner + l] /= band[i][reach];
    }
  }
}

std::vector<double> spline_coefficients(const std::vector<SplineAxis>& axes,
                                        std::span<const double> values) {
  std::vector<double> c(values.begin(), values.end());
  std::size_t outer = 1, inner = values.size();
  for (const SplineAxis& axis : axes) {
    inner /= axis.u.size();
    solve_along(axis, outer, inner, c);
    outer *= axis.u.size();
  }
  c.insert(c.end(), 2, 0.0);
  return c;
}

} // namespace frictab::table
