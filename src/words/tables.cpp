// Describes grids and their limits.
#include "words/tables.h"

#include <fmt/format.h>

#include "codegen/table_text.h"
#include "core/no_value.h"
#include "core/text.h"
#include "table/beyond_data.h"
#include "table/distance.h"
#include "words/numbers.h"

namespace frictab::words {

namespace {

// Largest node count for which linear tables compile fast and fit into a core's cache.
constexpr std::size_t many_nodes = 50000;

std::string grid_text(const table::Table& table) {
  std::vector<std::string> axes;
  for (const table::TableAxis& axis : table.axes)
    axes.push_back(fmt::format("{} {}", axis.nodes.size(), axis.name));
  return axes.empty() ? "a constant" : join(axes, " \u00D7 ");
}

std::string interpolation_text(const table::Table& table) {
  if (table.axes.empty()) return "\u2013";
  return std::string(table::interpolation_name(table.interpolation)) +
         (table.log_value ? " in its logarithm" : "");
}

void add_remarks(List& list, const table::Table& table) {
  const auto add = [&](const std::string& text) {
    if (!text.empty()) list.items.push_back(table.model + ": " + text);
  };
  add(codegen::edge_text(table));
  for (const table::TableAxis& axis : table.axes)
    if (const std::string beyond = table::beyond_data_text(axis); !beyond.empty())
      add(axis.name + ": " + beyond);
  for (const auto& [name, input] : table.record.inputs)
    if (input.held_why) add(name + ": " + *input.held_why);
  add(table::distance_text(table));
  if (table.interpolation == table::Interpolation::linear && table.nodes() > many_nodes)
    add("table.interpolation = \"cubic\" needs far fewer nodes where the law is smooth");
}

} // namespace

Section tables(const std::vector<table::Table>& all) {
  Section section{"tables", "Tables", "Tables"};
  if (all.empty()) {
    section.say("No table was made.");
    return section;
  }
  Table rows{"Tables",
             {{"law"}, {"nodes", true}, {"size", true}, {"of"}, {"interpolation"}, {"grid"}}};
  List remarks;
  for (const table::Table& table : all) {
    rows.rows.push_back(
        {{table.model, thousands(table.nodes()), human_bytes(static_cast<double>(table.bytes())),
          models::quantity_name(table.quantity), interpolation_text(table), grid_text(table)}});
    add_remarks(remarks, table);
  }
  section.add(std::move(rows));
  section.add(std::move(remarks));
  return section;
}

Table table_axes(const table::Table& table) {
  Table out{"Axes of the table of " + table.model,
            {{"axis"},
             {"unit"},
             {"from", true},
             {"to", true},
             {"nodes", true},
             {"interpolated in"},
             {"range from"}}};
  for (const table::TableAxis& axis : table.axes) {
    const bool any = !axis.nodes.empty();
    out.rows.push_back(
        {{code(axis.name), unit_text(axis.unit), short_figures(any ? axis.nodes.front() : no_value),
          short_figures(any ? axis.nodes.back() : no_value), thousands(axis.nodes.size()),
          axis.log ? "logarithm" : "the quantity itself",
          table.record.input(axis.name).range_from.value_or("\u2013")}});
  }
  return out;
}

std::string unit_text(const std::string& unit) {
  if (unit == "degC") return "\u00B0C";
  return unit.empty() || unit == "1" ? "\u2013" : unit;
}

} // namespace frictab::words
