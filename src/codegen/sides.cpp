// Lists the sides of axes by their answers.
#include "codegen/sides.h"

#include <algorithm>
#include <set>

#include "table/outside.h"

namespace frictab::codegen {

using table::Outside;

namespace {

std::vector<Side> sides_of(const table::AxisEnds& axis) {
  return {{axis.name, axis.input, axis.below, false, axis.low,
           axis.below == Outside::error ? axis.refused_below : axis.low},
          {axis.name, axis.input, axis.above, true, axis.high,
           axis.above == Outside::error ? axis.refused_above : axis.high}};
}

} // namespace

std::vector<Side> sides(const table::Table& table, Outside answer) {
  std::vector<Side> out;
  for (const table::AxisEnds& axis : table::axis_ends(table))
    for (const Side& side : sides_of(axis))
      if (side.answer == answer) out.push_back(side);
  return out;
}

std::vector<Side> clamped_sides(const table::Table& table) {
  const std::set<std::string> taken = expr::symbols(*table.extension);
  std::vector<Side> out;
  for (const table::AxisEnds& axis : table::axis_ends(table))
    for (const Side& side : sides_of(axis))
      if (side.answer != Outside::law && taken.contains(side.axis)) out.push_back(side);
  return out;
}

bool has_side(const table::Table& table, Outside answer) {
  return std::any_of(table.axes.begin(), table.axes.end(), [&](const table::TableAxis& axis) {
    return axis.below == answer || axis.above == answer;
  });
}

} // namespace frictab::codegen
