// Evaluates a table on one or two of its states.
#include "table/slice.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/columns.h"
#include "core/error.h"
#include "core/text.h"
#include "data/meaning.h"

namespace frictab::table {

namespace {

std::string unit_of(const Table& table, const std::string& name) {
  if (const TableAxis* axis = find_axis(table, name)) return axis->unit;
  return data::meaning_of(name).unit;
}

void check_along(const Table& table, const FixedStates& held,
                 const std::vector<std::string>& along) {
  for (std::size_t i = 0; i < along.size(); ++i) {
    check_input(table, along[i]);
    if (held.count(along[i]))
      throw InputError({}, fmt::format("{} is both held and run along", along[i]),
                       "keep --at or --along");
    if (std::ranges::count(along, along[i]) > 1)
      throw InputError({}, fmt::format("{} is named twice by --along", along[i]));
  }
}

} // namespace

Slice slice(const Table& table, const FixedStates& held, const std::vector<std::string>& along,
            std::size_t points) {
  check_along(table, held, along);
  check_fixed_states(table, held);
  check_all_known(table, held, along);
  Slice out{table.model, table.inputs(), along, {}, held, {}, {}, {}};
  std::size_t rows = 1;
  for (const std::string& name : along) {
    out.units.push_back(unit_of(table, name));
    out.values.push_back(evenly_spaced(table, name, points));
    rows *= points;
  }
  for (const std::string& name : out.inputs) {
    std::vector<double> column(rows);
    const auto at = std::ranges::find(along, name) - along.begin();
    const auto a = static_cast<std::size_t>(at);
    const std::size_t inner = a + 1 == along.size() ? 1 : points;
    for (std::size_t i = 0; i < rows; ++i)
      column[i] = a < along.size() ? out.values[a][i / inner % points] : held.at(name);
    out.states.push_back(std::move(column));
  }
  out.tau_MPa.resize(rows);
  TableFunction(table).evaluate(rows, pointers(out.states), out.tau_MPa);
  return out;
}

std::string slice_csv(const Slice& slice) {
  std::string text = join(slice.inputs, ",") + ",tau_R_MPa\n";
  for (std::size_t i = 0; i < slice.tau_MPa.size(); ++i) {
    for (const auto& column : slice.states)
      text += shortest(column[i]) + ",";
    text += shortest(slice.tau_MPa[i]) + "\n";
  }
  return text;
}

} // namespace frictab::table
