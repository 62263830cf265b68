// Writes law, units, arguments and the behaviour outside the range.
#include "codegen/entry_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "codegen/values_file.h"
#include "table/outside.h"

namespace frictab::codegen {

std::vector<std::string> about_entry(const ExportRequest& request) {
  const table::Table& table = request.table;
  std::vector<std::string> lines = {fmt::format("Law: {}", comment_text(table.model)),
                                    fmt::format("Data: {}", comment_text(origin_text(table))),
                                    fmt::format("Units: {} ({})", request.units.system().name,
                                                names_of_units(request.units, " in ")),
                                    fmt::format("Worst drift from the law: {}", drift_text(table))};
  for (const std::string& line : wrap_text("tau_R_MPa = " + expr::to_text(table.combine), 92))
    lines.push_back(comment_text(line));
  return lines;
}

std::vector<std::string> argument_texts(const ExportRequest& request,
                                        const std::vector<InputArgument>& inputs) {
  std::vector<std::string> texts;
  for (const InputArgument& input : inputs)
    texts.push_back(
        fmt::format("{} ({}): {}; {}", input.argument, input.solver.name, input.meaning,
                    input.used ? range_text(input, request.table) : "not used by this law"));
  return texts;
}

std::vector<std::string> argument_lines(const ExportRequest& request,
                                        const std::vector<InputArgument>& inputs) {
  return comment_lines(argument_texts(request, inputs), 88, "    ");
}

std::vector<std::string> outside_bits(const table::Table& table, const std::string& suffix) {
  std::vector<std::string> names;
  for (const table::AxisEnds& end : table::all_ends(table))
    names.push_back(fmt::format("{}{} {}", 1u << names.size(), suffix, comment_text(end.name)));
  if (names.empty()) names.push_back("none, the table has no axes");
  return names;
}

std::vector<std::string> entry_notes(const ExportRequest& request) {
  const table::Table& table = request.table;
  std::vector<std::string> text;
  const auto add_wrapped = [&](const std::string& sentence) {
    for (const std::string& line : comment_lines({sentence}, 88))
      text.push_back(line);
  };
  if (table.is_direct()) text.push_back("This is the law itself, not a table.");
  const std::vector<std::string> sides = outside_lines(table);
  if (sides.empty()) {
    const std::string what = table.is_direct() ? "law's" : "table's";
    add_wrapped("Outside the range the " + what + " value at the nearest edge is used, while " +
                unchanged_states(table) +
                " enter the formula above unchanged; frictab_outside shows which axes are "
                "concerned.");
  } else {
    text.push_back("Outside the range (frictab_outside shows which axes are concerned):");
    for (const std::string& side : sides)
      text.push_back("  " + comment_text(side));
    add_wrapped("The formula above takes unchanged: " + unchanged_states(table) + ".");
  }
  text.push_back("NaN in an argument that is used gives NaN. Thread-safe.");
  for (const std::string& line : values_file_lines(request, ""))
    add_wrapped(line);
  return text;
}

std::vector<std::string> unused_arguments(const std::vector<InputArgument>& inputs) {
  std::vector<std::string> names;
  for (const InputArgument& input : inputs)
    if (!input.used) names.push_back(input.argument);
  return names;
}

std::vector<std::string> without_range(const table::Table& table,
                                       const std::vector<InputArgument>& inputs) {
  std::vector<std::string> names;
  const std::vector<table::AxisEnds> ends = table::all_ends(table);
  for (const InputArgument& input : inputs)
    if (std::none_of(ends.begin(), ends.end(),
                     [&](const table::AxisEnds& end) { return end.name == input.name; }))
      names.push_back(input.argument);
  return names;
}

} // namespace frictab::codegen
