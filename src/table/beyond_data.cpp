// Counts nodes outside the range of the data.
#include "table/beyond_data.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::table {

std::size_t nodes_beyond_data(const TableAxis& axis) {
  if (!axis.data) return 0;
  const auto beyond = [&](double x) { return x < axis.data->first || x > axis.data->second; };
  return static_cast<std::size_t>(std::ranges::count_if(axis.nodes, beyond));
}

double share_beyond_data(const TableAxis& axis) {
  if (axis.nodes.empty()) return 0;
  return static_cast<double>(nodes_beyond_data(axis)) / static_cast<double>(axis.nodes.size());
}

std::string beyond_data_text(const TableAxis& axis) {
  const std::size_t beyond = nodes_beyond_data(axis);
  if (beyond == 0) return "";
  const auto [low, high] = *axis.data;
  std::vector<std::string> sides;
  if (axis.nodes.front() < low)
    sides.push_back(fmt::format("from {:.4g} down to {:.4g}", low, axis.nodes.front()));
  if (axis.nodes.back() > high)
    sides.push_back(fmt::format("from {:.4g} up to {:.4g}", high, axis.nodes.back()));
  return fmt::format("{} of {} nodes ({:.0f} %) beyond the data: {}{}", thousands(beyond),
                     thousands(axis.nodes.size()), 100 * share_beyond_data(axis), join(sides, ", "),
                     axis.unit == "1" ? "" : " " + axis.unit);
}

} // namespace frictab::table
