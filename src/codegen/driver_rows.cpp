// Rows of states against what one contact point, and one call, can be.
#include "codegen/driver_rows.h"

#include <algorithm>
#include <compare>

#include "codegen/histories.h"

namespace frictab {

bool posed(const std::vector<SolverInput>& inputs, std::span<const double* const> columns,
           std::size_t row, double otherwise) {
  double pressure = otherwise;
  std::optional<double> slip, peak;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const double value = columns[c][row];
    if (inputs[c].source == Source::pressure) pressure = value;
    if (inputs[c].source == Source::peak_pressure) peak = value;
    if (inputs[c].source != Source::slip) continue;
    if (slip && *slip != value) return false;
    slip = value;
  }
  if (!history_posed(inputs, columns, row)) return false;
  return !peak || !(*peak < pressure); // NaN is posed
}

std::vector<std::vector<std::size_t>> call_groups(const std::vector<SolverInput>& inputs,
                                                  std::vector<std::size_t> rows,
                                                  std::span<const double* const> columns,
                                                  std::size_t most) {
  std::vector<const double*> properties;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (inputs[c].source == Source::property) properties.push_back(columns[c]);
  for (std::size_t p = properties.size(); p-- > 0;)
    std::stable_sort(rows.begin(), rows.end(), [x = properties[p]](std::size_t a, std::size_t b) {
      return std::strong_order(x[a], x[b]) < 0;
    });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t row : rows) {
    const auto differs = [&](const double* x) { return x[groups.back().front()] != x[row]; };
    if (groups.empty() || groups.back().size() == most ||
        std::any_of(properties.begin(), properties.end(), differs))
      groups.emplace_back();
    groups.back().push_back(row);
  }
  return groups;
}

} // namespace frictab
