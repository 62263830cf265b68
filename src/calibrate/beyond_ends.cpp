// Counts rows outside the clamped range, input by input.
#include "calibrate/beyond_ends.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::calibrate {

void RowsBeyond::add(const models::Law& law, const std::vector<std::string>& names,
                     const InputColumns& columns, const data::Dataset& data) {
  if (law.clamped_inputs.empty()) return;
  std::vector<char> outside(data.rows(), 0);
  const auto behind = [&](std::size_t row) {
    return static_cast<std::size_t>(data.row_weight(row));
  };
  for (const auto& [name, ends] : law.clamped_inputs) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) continue;
    const auto values = columns[static_cast<std::size_t>(found - names.begin())];
    auto& [below, above] = sides[name];
    for (std::size_t row = 0; row < data.rows(); ++row) {
      const bool low = values[row] < ends.first;
      const bool high = values[row] > ends.second;
      if (low) below += behind(row);
      if (high) above += behind(row);
      if (low || high) outside[row] = 1;
    }
  }
  for (std::size_t row = 0; row < data.rows(); ++row)
    if (outside[row]) any += behind(row);
  rows += data.source_rows();
}

void RowsBeyond::add(const RowsBeyond& more) {
  for (const auto& [name, counts] : more.sides) {
    sides[name].first += counts.first;
    sides[name].second += counts.second;
  }
  any += more.any;
  rows += more.rows;
}

std::vector<std::string> RowsBeyond::told(const models::Law& law, const std::string& data) const {
  std::vector<std::string> said;
  for (const auto& [name, ends] : law.clamped_inputs) {
    const auto counted = sides.find(name);
    if (counted == sides.end()) continue;
    const auto& [below, above] = counted->second;
    if (below > 0)
      said.push_back(fmt::format("{} below {} ({})", name, shortest(ends.first), thousands(below)));
    if (above > 0)
      said.push_back(
          fmt::format("{} above {} ({})", name, shortest(ends.second), thousands(above)));
  }
  if (said.empty()) return {};
  return {fmt::format("{} of {} {} rows lie beyond the ends at which the law is held: {}",
                      thousands(any), thousands(rows), data, join(said, ", "))};
}

} // namespace frictab::calibrate
