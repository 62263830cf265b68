// Describes a table file by its own attributes: axes, formula, drift, storage layout.
#include "table/info.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "core/text_table.h"
#include "data/quantity.h"
#include "io/json.h"
#include "table/beyond_data.h"
#include "table/distance.h"
#include "table/outside.h"
#include "table/states.h"

namespace frictab::table {

namespace {

// "even" is to 1e-9 of a step in the coordinate, as for the kernel.
std::string spacing_of(const TableAxis& axis) {
  return axis.per_step() > 0 ? "even" : "graded";
}

std::string storage_text(const io::Hdf5Layout& layout) {
  if (layout.chunk.empty()) return "in one piece";
  std::vector<std::string> sizes;
  for (const std::size_t size : layout.chunk)
    sizes.push_back(std::to_string(size));
  std::string text = "chunks of " + join(sizes, " x ");
  if (!layout.filters.empty()) text += ", " + join(layout.filters, ", ");
  return text;
}

// Treats NaN as absent: a file may use it for a number that is not known.
std::optional<double> stated(std::optional<double> number) {
  return number && std::isnan(*number) ? std::nullopt : number;
}

std::string worst_state(const Table& table) {
  std::string text;
  for (const std::string& name : table.inputs())
    if (const auto at = stated(table.record.input(name).worst_case_at))
      text += fmt::format("{}{}={:g}", text.empty() ? "" : " ", name, *at);
  return text;
}

std::string axis_text(const Table& table, const TableAxis& axis) {
  const data::Quantity* known = data::find_quantity(axis.name);
  std::string text =
      fmt::format("{:g} .. {:g}{}, {} nodes, {} in {}{}", axis.nodes.front(), axis.nodes.back(),
                  axis.unit == "1" ? "" : " " + axis.unit, axis.nodes.size(), spacing_of(axis),
                  axis.log ? "ln " : "", known ? known->symbol : axis.name);
  for (std::size_t i = 0; i < axis.kinks.size(); ++i)
    text += fmt::format("{} {:g}", i ? "," : "; kinks at", axis.kinks[i]);
  if (axis.below != Outside::clamp || axis.above != Outside::clamp)
    text += fmt::format("; outside: {} below, {} above", outside_name(axis.below),
                        outside_name(axis.above));
  if (const std::string beyond = beyond_data_text(axis); !beyond.empty()) text += "; " + beyond;
  if (const auto held = table.record.input(axis.name).held_why) text += "; " + *held;
  return text;
}

std::string input_text(const Table& table, const std::string& name) {
  const auto range = table.range(name);
  const InputRecord& input = table.record.input(name);
  const std::string unit = input.unit.value_or(""), levels = input.levels.value_or("");
  return fmt::format(
      "no axis{}{}{}",
      range ? fmt::format(", verified from {:g} to {:g}", range->first, range->second) : "",
      unit.empty() || unit == "1" ? "" : " " + unit, levels.empty() ? "" : "; " + levels);
}

void add_axes(std::string& out, const Table& table) {
  out += table.axes.empty() ? "Axes: none, the value is a constant\n" : "Axes:\n";
  std::vector<std::vector<std::string>> rows;
  for (const TableAxis& axis : table.axes)
    rows.push_back({axis.name, axis_text(table, axis)});
  for (const std::string& name : table.inputs())
    if (!find_axis(table, name)) rows.push_back({name, input_text(table, name)});
  out += text_table(rows, {});
}

void add_drift(std::string& out, const Table& table) {
  const std::string state = worst_state(table);
  if (const auto tolerance = stated(table.record.tolerance_MPa))
    out += fmt::format("Tolerance: {:.4g} MPa{}{}\n", *tolerance,
                       table.record.tolerance_from ? ", " : "",
                       table.record.tolerance_from.value_or(""));
  const auto worst = stated(table.record.worst_case_MPa);
  if (worst)
    out += fmt::format("Drift, as the file says: {:.4g} MPa, the largest found{}\n", *worst,
                       state.empty() ? "" : ", at " + state);
  const auto proven = stated(table.record.proven_drift_MPa);
  if (proven)
    out += fmt::format("Proven, as the file says: nowhere above {:.3g} MPa\n", rounded_up(*proven));
  if (worst || proven) out += "  (`frictab verify --table FILE --model MODEL` measures it again)\n";
}

} // namespace

std::string info_text(const TableDescription& description, const std::string& file) {
  const Table& table = description.table;
  const TableRecord& record = table.record;
  const std::string formula = record.formula.value_or(""), origin = record.data_origin.value_or("");
  std::string out =
      fmt::format("{}: table of {}{}\n", file, table.model, formula.empty() ? "" : ", " + formula);
  add_axes(out, table);
  out += fmt::format(
      "Value: {}, {}{}{}\n", models::quantity_name(table.quantity),
      interpolation_name(table.interpolation), table.log_value ? " in its logarithm" : "",
      table.quantile() == 0.5 ? std::string() : fmt::format(", quantile {:g}", table.quantile()));
  out += "tau_R_MPa = " + expr::to_text(table.combine) + "\n";
  for (const auto& [name, value] : table.constants)
    out += fmt::format("  {} = {}\n", name, shortest(value));
  add_drift(out, table);
  if (const std::string far = distance_text(table); !far.empty()) out += "Tests: " + far + "\n";
  out += fmt::format("Nodes: {}, {} of values; {} in the file, {}\n", thousands(table.nodes()),
                     human_bytes(8.0 * static_cast<double>(table.nodes())),
                     human_bytes(static_cast<double>(description.layout.stored_bytes)),
                     storage_text(description.layout));
  if (!origin.empty()) out += "Data: " + origin + ", hash " + record.data_hash.value_or("") + "\n";
  if (const std::string tool = record.tool_version.value_or(""); !tool.empty())
    out += "Made by: frictab " + tool + "\n";
  return out;
}

namespace {

nlohmann::ordered_json axis_json(const TableAxis& axis) {
  nlohmann::ordered_json j = {{"name", axis.name},
                              {"unit", axis.unit},
                              {"long_name", axis.long_name},
                              {"transform", axis.log ? "log" : "linear"},
                              {"spacing", spacing_of(axis)},
                              {"kinks", axis.kinks},
                              {"outside", {outside_name(axis.below), outside_name(axis.above)}}};
  if (axis.data) {
    j["data"] = {axis.data->first, axis.data->second};
    j["share_beyond_data"] = share_beyond_data(axis);
  }
  j["nodes"] = axis.nodes;
  return j;
}

} // namespace

std::string info_json(const TableDescription& description, const std::string& file) {
  const Table& table = description.table;
  const TableAttributes attributes = root_attributes(table);
  auto axes = nlohmann::ordered_json::array();
  for (const TableAxis& axis : table.axes)
    axes.push_back(axis_json(axis));
  nlohmann::ordered_json j = {{"schema", "frictab/table_info/1"},
                              {"file", file},
                              {"model", table.model},
                              {"inputs", table.inputs()},
                              {"axes", axes},
                              {"quantity", models::quantity_name(table.quantity)},
                              {"transform", table.log_value ? "log" : "linear"},
                              {"interpolation", interpolation_name(table.interpolation)},
                              {"combine", expr::to_text(table.combine)},
                              {"constants", table.constants},
                              {"nodes", table.nodes()},
                              {"value_bytes", 8 * table.nodes()},
                              {"stored_bytes", description.layout.stored_bytes},
                              {"file_bytes", description.file_bytes},
                              {"chunk", description.layout.chunk},
                              {"filters", description.layout.filters},
                              {"attributes", attributes.texts}};
  for (const auto& [name, value] : attributes.numbers)
    j["attributes"][name] = value;
  return io::json_text(j);
}

} // namespace frictab::table
