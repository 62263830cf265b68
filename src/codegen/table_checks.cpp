// Rejects tables from which no routine can be made.
#include "codegen/table_checks.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/sides.h"
#include "core/error.h"
#include "core/text.h"
#include "table/frictab_kernel.h"

namespace frictab::codegen {

void check_table(const table::Table& table) {
  FaultList faults;
  std::size_t nodes = 1;
  for (const table::TableAxis& axis : table.axes) {
    nodes *= axis.nodes.size();
    for (std::size_t i = 0; i < axis.nodes.size(); ++i)
      if (!std::isfinite(axis.nodes[i]) || (i > 0 && axis.nodes[i] <= axis.nodes[i - 1]) ||
          (axis.log && axis.nodes[i] <= 0))
        faults.add({}, fmt::format("the nodes of the table's axis '{}' do not ascend", axis.name));
    if (axis.nodes.size() < 2)
      faults.add({}, fmt::format("the table's axis '{}' has fewer than two nodes", axis.name));
  }
  if (table.axes.size() > FT_MAX_AXES)
    faults.add({}, fmt::format("the table has {} axes; generated code holds at most {}",
                               table.axes.size(), FT_MAX_AXES));
  if (!table.is_direct() && nodes != table.value.size())
    faults.add({}, fmt::format("the table has {} values for {} nodes", table.value.size(), nodes));
  if (!std::all_of(table.value.begin(), table.value.end(),
                   [](double v) { return std::isfinite(v); }))
    faults.add({}, "the table holds values that are not finite");
  if ((has_side(table, table::Outside::law) || table.is_direct()) && !table.extension)
    faults.add({}, fmt::format("the table of {} does not hold the law's own formula", table.model),
               "tabulate again with outside = \"law\" in [table.axes]");
  faults.throw_if_any();
}

void check_table_size(const table::Table& table, std::size_t elsewhere, const std::string& remedy) {
  const std::size_t numbers = baked_numbers(table) - elsewhere;
  if (numbers <= most_baked_numbers) return;
  const std::string cubic = is_cubic(table) ? "" : "table.interpolation = \"cubic\", ";
  throw InputError(
      {},
      fmt::format("the table of {} needs {} numbers in the source; a compiler takes {} in "
                  "reasonable time and memory",
                  table.model, thousands(numbers), thousands(most_baked_numbers)),
      remedy + cubic + smaller_table);
}

} // namespace frictab::codegen
