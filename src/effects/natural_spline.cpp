// Computes splines by tridiagonal solves over the knots. Their pieces are cubes of clamped
// coordinates, whose sum does not cancel even for very uneven knots.
#include "effects/natural_spline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace frictab::effects {

using expr::Expr;

namespace {

constexpr double least_distance = 1.0 / 200; // between knots, as a fraction of their range

// Returns the distances of neighbouring knots as fractions of their range.
std::vector<double> distances(std::span<const double> knots) {
  std::vector<double> h;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i)
    h.push_back((knots[i + 1] - knots[i]) / (knots.back() - knots.front()));
  return h;
}

// Returns the second derivatives at the knots of the spline through `values`: 0 at both ends; the
// others solve (Thomas) h0 m0 + 2 (h0 + h1) m1 + h1 m2 = 6 ((v2 - v1)/h1 - (v1 - v0)/h0).
std::vector<double> second_derivatives(const std::vector<double>& h,
                                       std::span<const double> values) {
  const std::size_t n = values.size();
  std::vector<double> m(n, 0.0), above(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double right =
        6 * ((values[i + 1] - values[i]) / h[i] - (values[i] - values[i - 1]) / h[i - 1]);
    const double pivot = 2 * (h[i - 1] + h[i]) - h[i - 1] * above[i - 1];
    above[i] = h[i] / pivot;
    m[i] = (right - h[i - 1] * m[i - 1]) / pivot;
  }
  for (std::size_t i = n; i-- > 1;)
    if (i + 1 < n) m[i] -= above[i] * m[i + 1];
  return m;
}

// Returns the matrix, by rows, that maps values to second derivatives.
std::vector<std::vector<double>> bending(std::span<const double> knots) {
  const std::size_t n = knots.size();
  const auto h = distances(knots);
  std::vector<std::vector<double>> rows(n, std::vector<double>(n));
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> one(n, 0.0);
    one[k] = 1;
    const auto m = second_derivatives(h, one);
    for (std::size_t i = 0; i < n; ++i)
      rows[i][k] = m[i];
  }
  return rows;
}

Expr weighted_sum(std::span<const double> weights, std::span<const Expr> values) {
  Expr sum = 0.0;
  bool any = false;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    if (weights[k] == 0) continue;
    const Expr term = weights[k] * values[k];
    sum = any ? sum + term : term;
    any = true;
  }
  return sum;
}

} // namespace

std::vector<double> spline_knots(std::span<const double> values, int count) {
  std::vector<double> sorted;
  std::ranges::copy_if(values, std::back_inserter(sorted),
                       [](double value) { return std::isfinite(value); });
  std::ranges::sort(sorted);
  if (sorted.empty()) return {0.0};
  std::vector<double> knots{sorted.front()};
  const double least = least_distance * (sorted.back() - sorted.front());
  std::vector<double> different = sorted;
  different.erase(std::unique(different.begin(), different.end()), different.end());
  const auto wanted = static_cast<std::size_t>(count);
  // Few values all become knots; otherwise quantiles do.
  const auto& from = different.size() <= wanted ? different : sorted;
  const std::size_t last = std::min(wanted, from.size()) - 1;
  for (std::size_t i = 1; i < last; ++i)
    if (const double at = from[i * (from.size() - 1) / last];
        at - knots.back() > least && sorted.back() - at > least)
      knots.push_back(at);
  if (sorted.back() > sorted.front()) knots.push_back(sorted.back());
  return knots;
}

NaturalSpline::NaturalSpline(const Expr& x, std::span<const double> knots) {
  if (knots.size() < 2) return;
  const auto h = distances(knots);
  bending_ = bending(knots);
  for (std::size_t j = 0; j < h.size(); ++j) {
    // The order of the operands matters: at a knot only the piece above it has a slope.
    const Expr t = minimum(1.0, maximum((x - knots[j]) / (knots[j + 1] - knots[j]), 0.0));
    const Expr rest = 1.0 - t;
    const double bend = h[j] * h[j] / 6;
    pieces_.push_back({t, bend * (rest * rest * rest - rest), bend * (t * t * t - t)});
  }
}

Expr NaturalSpline::operator()(std::span<const Expr> values) const {
  Expr sum = values[0];
  std::vector<Expr> m;
  for (const auto& row : bending_)
    m.push_back(weighted_sum(row, values));
  for (std::size_t j = 0; j < pieces_.size(); ++j) {
    sum = sum + (values[j + 1] - values[j]) * pieces_[j].t;
    if (j > 0) sum = sum + m[j] * pieces_[j].left;
    if (j + 1 < pieces_.size()) sum = sum + m[j + 1] * pieces_[j].right;
  }
  return sum;
}

std::vector<double> spline_roughness(std::span<const double> knots) {
  const std::size_t n = knots.size();
  std::vector<double> matrix(n * n, 0.0);
  if (n < 3) return matrix;
  const auto h = distances(knots);
  const auto rows = bending(knots);
  // The second derivative is linear between knots.
  for (std::size_t j = 0; j + 1 < n; ++j)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = 0; b < n; ++b)
        matrix[a * n + b] += h[j] / 6 *
                             (2 * rows[j][a] * rows[j][b] + rows[j][a] * rows[j + 1][b] +
                              rows[j + 1][a] * rows[j][b] + 2 * rows[j + 1][a] * rows[j + 1][b]);
  return matrix;
}

std::vector<double> tensor_roughness(const std::vector<std::vector<double>>& parts) {
  std::vector<std::size_t> size;
  std::size_t count = 1;
  for (const auto& part : parts) {
    size.push_back(static_cast<std::size_t>(std::lround(std::sqrt(part.size()))));
    count *= size.back();
  }
  std::vector<double> matrix(count * count, 0.0);
  std::size_t stride = count;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    stride /= size[p];
    for (std::size_t row = 0; row < count; ++row) {
      const std::size_t own = row / stride % size[p];
      for (std::size_t to = 0; to < size[p]; ++to)
        matrix[row * count + row - own * stride + to * stride] += parts[p][own * size[p] + to];
    }
  }
  return matrix;
}

std::vector<double> scaled_penalty(std::vector<double> matrix) {
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(matrix.size())));
  double trace = 0;
  for (std::size_t i = 0; i < n; ++i)
    trace += matrix[i * n + i];
  if (trace > 0)
    for (double& value : matrix)
      value *= static_cast<double>(n) / trace;
  for (std::size_t i = 0; i < n; ++i)
    matrix[i * n + i] += 1e-3;
  return matrix;
}

std::vector<double> half_wave_pattern(std::span<const double> knots) {
  std::vector<double> values;
  for (const double knot : knots)
    values.push_back(knots.size() < 2 ? 1.0
                                      : std::sin(std::numbers::pi * (knot - knots.front()) /
                                                 (knots.back() - knots.front())));
  return values;
}

std::string knots_text(std::span<const double> knots, std::span<const double> changes) {
  std::string text;
  for (std::size_t k = 0; k < knots.size(); ++k)
    text += fmt::format("{}({:.4g}, {:.4g})", k > 0 ? ", " : "", knots[k], 1 + changes[k]);
  return text;
}

} // namespace frictab::effects
