// Minimises Orowan's sum of squares wedge by wedge.
#include "calibrate/orowan_optimum.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace frictab::calibrate {

namespace {

// Returns row numbers in the order of sigma_N/k. A first pass deals them into buckets of equal
// width, so that each sort is short; ratios that all fall into one bucket only make it slower.
std::vector<std::uint32_t> in_order(const std::vector<double>& ratio) {
  const auto [least, most] = std::ranges::minmax_element(ratio);
  const double low = *least, high = *most;
  const std::size_t buckets = ratio.size() / 4 + 1;
  const double per = high > low ? static_cast<double>(buckets - 1) / (high - low) : 0;
  const auto bucket = [&](double r) { return static_cast<std::size_t>((r - low) * per); };
  std::vector<std::uint32_t> end(buckets + 1, 0), order(ratio.size());
  for (const double r : ratio)
    ++end[bucket(r) + 1];
  for (std::size_t b = 0; b < buckets; ++b)
    end[b + 1] += end[b];
  for (std::uint32_t i = 0; i < order.size(); ++i)
    order[end[bucket(ratio[i])]++] = i;
  auto begin = order.begin();
  for (std::size_t b = 0; b < buckets; ++b) {
    const auto stop = order.begin() + end[b];
    std::sort(begin, stop, [&](std::uint32_t a, std::uint32_t c) { return ratio[a] < ratio[c]; });
    begin = stop;
  }
  return order;
}

// Sum of (tau - p g)^2 as a function of p, less the sum of tau^2.
struct Quadratic {
  double gg = 0, gt = 0;
  void add(double g, double t, double weight) {
    gg += weight * g * g;
    gt += weight * g * t;
  }
  double at(double p) const { return p * (p * gg - 2 * gt); }
  double lowest() const { return gg > 0 ? std::clamp(gt / gg, 0.0, 1.0) : 0; }
};

struct Best {
  OrowanPoint point;
  double cost = std::numeric_limits<double>::infinity();
  void offer(const OrowanPoint& p, double c) {
    if (c >= cost) return;
    point = p;
    cost = c;
  }
};

// Offers the optimum of a wedge: Coulomb friction for ratios up to `last`, shear friction from
// `next`.
void offer_wedge(const Quadratic& coulomb, const Quadratic& shear, double last, double next,
                 Best& best) {
  const OrowanPoint p{coulomb.lowest(), shear.lowest()};
  if (p.mu * last <= p.m && p.mu * next >= p.m) best.offer(p, coulomb.at(p.mu) + shear.at(p.m));
}

// Offers the optimum on the border of two wedges, where the kink is m = ratio mu.
void offer_border(const Quadratic& coulomb, const Quadratic& shear, double ratio, Best& best) {
  const Quadratic along{coulomb.gg + ratio * ratio * shear.gg, coulomb.gt + ratio * shear.gt};
  const double mu = std::min(along.lowest(), ratio > 1 ? 1 / ratio : 1); // m <= 1
  best.offer({mu, std::min(ratio * mu, 1.0)}, along.at(mu));
}

} // namespace

std::vector<OrowanPoint> orowan_optimum(const OrowanRows& rows, std::size_t breaks) {
  const std::size_t count = rows.tau.size();
  std::vector<double> ratio(count);
  Quadratic coulomb, shear;
  const auto weight = [&](std::size_t i) { return rows.weights.empty() ? 1.0 : rows.weights[i]; };
  for (std::size_t i = 0; i < count; ++i) {
    ratio[i] = rows.sigma_n[i] / std::max(rows.k[i], 1e-300);
    shear.add(rows.k[i], rows.tau[i], weight(i));
  }
  const auto order = in_order(ratio);
  Best best;
  if (shear.lowest() <= ratio[order[0]]) // shear friction everywhere: mu has no effect
    best.offer({1, shear.lowest()}, shear.at(shear.lowest()));
  std::vector<OrowanPoint> points(1);
  double last = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t row = order[i];
    offer_wedge(coulomb, shear, last, ratio[row], best);
    offer_border(coulomb, shear, ratio[row], best);
    if (points.size() <= breaks && i >= (2 * points.size() - 1) * count / (2 * breaks)) {
      Best here;
      offer_border(coulomb, shear, ratio[row], here);
      points.push_back(here.point);
    }
    coulomb.add(rows.sigma_n[row], rows.tau[row], weight(row));
    shear.add(rows.k[row], rows.tau[row], -weight(row));
    last = ratio[row];
  }
  // Without shear friction m has no effect. Such a point is preferred to an equally good kink at
  // the last row.
  const double mu = coulomb.lowest();
  if (mu * last <= 1 && coulomb.at(mu) <= best.cost + 1e-13 * std::abs(best.cost))
    best.point = {mu, 1};
  points[0] = best.point;
  return points;
}

} // namespace frictab::calibrate
