// States of grid nodes, the law's piece there, and the attributes of a table.
#include "table/sampling.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/os/machine.h"
#include "core/text.h"
#include "data/meaning.h"
#include "table/direct.h"

namespace frictab::table {

std::size_t count_nodes(const std::vector<TableAxis>& axes) {
  std::size_t nodes = 1;
  for (const TableAxis& axis : axes) {
    if (nodes > SIZE_MAX / 16 / axis.nodes.size()) return SIZE_MAX / 16;
    nodes *= axis.nodes.size();
  }
  return nodes;
}

bool fits_into_memory(std::size_t nodes) {
  return sizeof(double) * static_cast<double>(nodes) < 0.5 * os::machine_memory();
}

namespace {

// Fills in the coordinate of one axis at consecutive nodes of the grid; `stride` nodes share one.
void fill_states(const std::vector<double>& nodes, std::size_t stride, std::size_t first,
                 std::vector<double>& states) {
  std::size_t node = first / stride % nodes.size(), same = stride - first % stride;
  for (std::size_t i = 0; i < states.size();) {
    const std::size_t end = i + std::min(same, states.size() - i);
    for (; i < end; ++i)
      states[i] = nodes[node];
    node = node + 1 == nodes.size() ? 0 : node + 1;
    same = stride;
  }
}

} // namespace

void sample_nodes(const Pieces& pieces, const std::vector<StateRange>& ranges,
                  const std::vector<TableAxis>& axes, std::size_t first, std::span<double> values) {
  std::vector<std::vector<double>> states;
  std::vector<const double*> columns;
  for (const StateRange& range : ranges) {
    states.emplace_back(values.size(), range.low);
    std::size_t stride = 1; // nodes per step of this axis
    for (std::size_t a = axes.size(); a-- > 0;) {
      if (axes[a].name == range.name) fill_states(axes[a].nodes, stride, first, states.back());
      stride *= axes[a].nodes.size();
    }
    columns.push_back(states.back().data());
  }
  pieces.value.evaluate(values.size(), columns, pieces.parameters, values.data());
}

namespace {

// "0 = A, 1 = B".
std::string numbered(const std::vector<std::string>& levels) {
  std::vector<std::string> texts;
  for (const std::string& level : levels)
    texts.push_back(fmt::format("{} = {}", texts.size(), level));
  return join(texts, ", ");
}

// Adds unit and meaning for an input that is not a canonical state.
void describe_further_input(InputRecord& input, const models::Law& law, const std::string& name) {
  const data::Meaning meaning = data::meaning_of(name);
  if (meaning.state) return;
  input.unit = meaning.unit;
  input.long_name = meaning.text;
  if (const auto levels = law.levels.find(name); levels != law.levels.end())
    input.levels = numbered(levels->second);
}

} // namespace

Table describe_table(const models::AssembledLaw& law, const std::vector<StateRange>& ranges,
                     std::vector<TableAxis> axes, Interpolation interpolation, bool log_value) {
  const models::Model& model = law.model;
  Table table;
  table.model = model.name();
  table.quantity = model.law->quantity;
  table.log_value = log_value;
  table.interpolation = interpolation;
  table.axes = std::move(axes);
  table.combine = law.combine;
  add_constants(table, law, table.combine);
  if (std::ranges::any_of(table.axes, [](const TableAxis& axis) {
        return axis.below == Outside::law || axis.above == Outside::law;
      }))
    add_extension(table, law);
  for (const StateRange& range : ranges) {
    InputRecord& input = table.record.inputs[range.name];
    input.low = range.low;
    input.high = range.high;
    input.range_from = range.why;
    if (!range.why_held.empty()) input.held_why = range.why_held;
    describe_further_input(input, *model.law, range.name);
  }
  table.record.quantile = model.quantile;
  table.record.gain = model.gain;
  table.record.formula = model.law->formula;
  table.record.shear_yield = models::shear_yield_name(model.conventions.shear_yield);
  return table;
}

namespace {

std::string state_at(const Table& table, std::size_t node) {
  const std::vector<double> values = values_at(table.axes, node);
  std::vector<std::string> parts;
  for (std::size_t a = 0; a < values.size(); ++a)
    parts.push_back(fmt::format("{} = {:g}", table.axes[a].name, values[a]));
  return join(parts, ", ");
}

} // namespace

void check_finite(const Table& table, std::size_t first, std::span<const double> values,
                  const Place& place) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(table.coordinate(values[i])))
      throw InputError(place,
                       fmt::format("{}{} of {} is not finite at {}", table.log_value ? "ln " : "",
                                   models::quantity_name(table.quantity), table.model,
                                   state_at(table, first + i)),
                       "narrower ranges in [table.axes], or another law");
}

} // namespace frictab::table
