// Counts rows outside the clamped range, input by input.
#include "calibrate/beyond_ends.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::calibrate {

void RowsBeyond::add(const models::Law& law, const InputColumns& columns,
                     const data::Dataset& data) {
  if (law.clamped_inputs.empty()) return;
  std::vector<char> outside(data.rows(), 0);
  const auto source_rows = [&](std::size_t row) {
    return static_cast<std::size_t>(data.row_weight(row));
  };
  for (const auto& [name, ends] : law.clamped_inputs) {
    const auto found = std::ranges::find(columns.names(), name);
    if (found == columns.names().end()) continue;
    const auto values = columns[static_cast<std::size_t>(found - columns.names().begin())];
    auto& [below, above] = sides[name];
    for (std::size_t row = 0; row < data.rows(); ++row) {
      const bool low = values[row] < ends.first;
      const bool high = values[row] > ends.second;
      if (low) below += source_rows(row);
      if (high) above += source_rows(row);
      if (low || high) outside[row] = 1;
    }
  }
  for (std::size_t row = 0; row < data.rows(); ++row)
    if (outside[row]) any += source_rows(row);
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

void RowsBeyond::add_remark(std::vector<std::string>& remarks, const models::Law& law,
                            const char* rows_of) const {
  std::vector<std::string> parts;
  for (const auto& [name, ends] : law.clamped_inputs) {
    const auto counted = sides.find(name);
    if (counted == sides.end()) continue;
    const auto& [below, above] = counted->second;
    if (below > 0)
      parts.push_back(fmt::format("{} below {:.5g} ({})", name, ends.first, thousands(below)));
    if (above > 0)
      parts.push_back(fmt::format("{} above {:.5g} ({})", name, ends.second, thousands(above)));
  }
  if (!parts.empty())
    remarks.push_back(
        fmt::format("{} of {} {} rows lie beyond the ends at which the law is held: {}",
                    thousands(any), thousands(rows), rows_of, join(parts, ", ")));
}

} // namespace frictab::calibrate
