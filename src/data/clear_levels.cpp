// Cuts sorted values at gaps that are wide in comparison with their range.
#include "data/clear_levels.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace frictab::data {

ClearLevels clear_levels(const std::vector<double>& values, double same) {
  constexpr double gap_share = 0.05, width_share = 0.25;
  ClearLevels levels;
  if (values.empty()) return levels;
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  const double span = values[order.back()] - values[order.front()];
  const double cut = span > same ? gap_share * span : span;
  double narrowest = std::numeric_limits<double>::infinity(), first = values[order.front()];
  std::vector<std::size_t> of(values.size());
  levels.count = 1;
  for (std::size_t i = 1; i < order.size(); ++i) {
    const double value = values[order[i]], gap = value - values[order[i - 1]];
    if (gap > cut) {
      ++levels.count;
      narrowest = std::min(narrowest, gap);
      first = value;
    }
    levels.width = std::max(levels.width, value - first);
    of[order[i]] = levels.count - 1;
  }
  const bool is_clear = levels.count == 1 ? span <= same
                                          : levels.width <= width_share * narrowest &&
                                                2 * levels.count <= values.size();
  if (!is_clear) return {};
  levels.of = std::move(of);
  return levels;
}

} // namespace frictab::data
