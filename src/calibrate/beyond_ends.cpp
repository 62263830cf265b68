// Counts them, input by input.
#include "calibrate/beyond_ends.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"

namespace frictab::calibrate {

std::vector<std::string> rows_beyond_ends(const models::Law& law,
                                          const std::vector<std::string>& names,
                                          const InputColumns& columns, std::size_t rows,
                                          const std::string& data) {
  std::vector<char> any(rows, 0);
  std::vector<std::string> sides;
  for (const auto& [name, ends] : law.held) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) continue;
    const auto values = columns[static_cast<std::size_t>(found - names.begin())];
    std::size_t below = 0, above = 0;
    for (std::size_t row = 0; row < rows; ++row) {
      below += values[row] < ends.first;
      above += values[row] > ends.second;
      if (values[row] < ends.first || values[row] > ends.second) any[row] = 1;
    }
    if (below > 0)
      sides.push_back(
          fmt::format("{} below {} ({})", name, shortest(ends.first), thousands(below)));
    if (above > 0)
      sides.push_back(
          fmt::format("{} above {} ({})", name, shortest(ends.second), thousands(above)));
  }
  if (sides.empty()) return {};
  const auto count = static_cast<std::size_t>(std::count(any.begin(), any.end(), 1));
  return {fmt::format("{} of {} {} rows lie beyond the ends at which the law is held: {}",
                      thousands(count), thousands(rows), data, join(sides, ", "))};
}

} // namespace frictab::calibrate
