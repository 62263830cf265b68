// Even axes, guides and their lower bounds.
#include "table/axis_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frictab::table {

namespace {

constexpr std::size_t most_bins = 1024;
constexpr int most_in_bin = 8;

// Computes the bin as ft_cell does.
int bin_of(const AxisSearch& axis, double u) {
  return static_cast<int>(u * axis.scale - axis.shift);
}

void set_scale(AxisSearch& axis, double scale, double below) {
  axis.scale = std::isfinite(scale) && std::isfinite(scale * axis.u.front()) &&
                       std::isfinite(scale * axis.u.back())
                   ? scale
                   : 0;
  axis.shift = axis.u.front() * axis.scale + below;
}

// Checks just below each node, where the guess has to be a cell that ends at the node or earlier.
bool never_passes(const AxisSearch& axis) {
  for (std::size_t i = 1; i < axis.u.size(); ++i) {
    const double below = std::nextafter(axis.u[i], -std::numeric_limits<double>::infinity());
    if (bin_of(axis, below) > static_cast<int>(i) - 1) return false;
  }
  return true;
}

bool search_even(AxisSearch& axis) {
  // Evenly spaced nodes may deviate from their exact positions by 1e-9 of a step.
  set_scale(axis, per_step(axis.u), 1e-8);
  return axis.scale > 0 && never_passes(axis);
}

// Stores per bin the last node that lies in a lower bin; false where too many nodes share a bin.
bool fill_guide(AxisSearch& axis) {
  axis.guide.assign(static_cast<std::size_t>(bin_of(axis, axis.u.back())) + 1, 0);
  int crowd = 0, in_bin = 0;
  for (std::size_t i = 1; i + 1 < axis.u.size(); ++i) {
    const auto bin = static_cast<std::size_t>(bin_of(axis, axis.u[i]));
    const bool same = bin == static_cast<std::size_t>(bin_of(axis, axis.u[i - 1]));
    in_bin = same ? in_bin + 1 : 1;
    crowd = std::max(crowd, in_bin);
    if (bin + 1 < axis.guide.size()) axis.guide[bin + 1] = static_cast<unsigned short>(i);
  }
  for (std::size_t b = 1; b < axis.guide.size(); ++b)
    axis.guide[b] = std::max(axis.guide[b], axis.guide[b - 1]);
  return crowd <= most_in_bin;
}

bool search_guide(AxisSearch& axis) {
  if (axis.u.size() > std::numeric_limits<unsigned short>::max()) return false;
  std::size_t bins = 16;
  const double range = axis.u.back() - axis.u.front();
  const auto crowded = [&] { // two nodes in one bin
    for (std::size_t i = 1; i < axis.u.size(); ++i)
      if (bin_of(axis, axis.u[i]) == bin_of(axis, axis.u[i - 1])) return true;
    return false;
  };
  do {
    bins *= 2;
    set_scale(axis, static_cast<double>(bins) / range, 0);
    if (!(axis.scale > 0)) return false;
  } while (bins < most_bins && (bins < 8 * axis.u.size() || crowded()));
  return fill_guide(axis);
}

} // namespace

double per_step(const std::vector<double>& u) {
  const double step = (u.back() - u.front()) / static_cast<double>(u.size() - 1);
  for (std::size_t i = 0; i < u.size(); ++i)
    if (!(std::abs(u[i] - (u.front() + step * static_cast<double>(i))) <= 1e-9 * step)) return 0;
  return 1 / step;
}

AxisSearch axis_search(std::vector<double> u, CellSearch search) {
  AxisSearch axis;
  axis.u = std::move(u);
  for (std::size_t i = 0; i + 1 < axis.u.size(); ++i)
    axis.per_cell.push_back(
        std::min(1 / (axis.u[i + 1] - axis.u[i]), std::numeric_limits<double>::max()));
  const bool even = search == CellSearch::fastest || search == CellSearch::even;
  const bool guide = search == CellSearch::fastest || search == CellSearch::guide;
  if (even && search_even(axis)) return axis;
  if (guide && search_guide(axis)) return axis;
  axis.scale = axis.shift = 0;
  axis.guide.clear();
  return axis;
}

ft_axis AxisSearch::axis(long stride) const {
  return {static_cast<int>(u.size()),
          stride,
          u.data(),
          per_cell.data(),
          scale,
          shift,
          guide.empty() ? nullptr : guide.data()};
}

} // namespace frictab::table
