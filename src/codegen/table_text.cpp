// Writes sentences about a table from its axes and its record.
#include "codegen/table_text.h"

#include <fmt/format.h>

#include "codegen/number_text.h"
#include "core/text.h"
#include "expr/expr.h"
#include "table/outside.h"
#include "table/states.h"

namespace frictab::codegen {

using table::Outside;

namespace {

const char* outside_text(Outside outside) {
  switch (outside) {
  case Outside::error:
    return "error (NaN)";
  case Outside::law:
    return "the law's own formula";
  case Outside::clamp:
    break;
  }
  return "the value at this end";
}

} // namespace

std::string range_text(const InputArgument& input, const table::Table& table) {
  const auto known = table.range(input.name);
  if (!known) return "no axis, any value";
  const SolverUnit& unit = input.solver;
  std::string text = fmt::format("{:.6g} .. {:.6g}", unit.from_canonical(known->first),
                                 unit.from_canonical(known->second));
  if (unit.name != "1") text += " " + unit.name;
  if (input.axis) return text;
  for (const table::AxisEnds& held : table::clamped_input_ends(table))
    if (held.name == input.name) return text + " (no axis; beyond it counts as outside)";
  return text + " (no axis: any value, verified there)";
}

std::vector<std::string> outside_lines(const table::Table& table) {
  std::vector<std::string> lines;
  bool all_clamp = true, some_error = false;
  for (const table::TableAxis& axis : table.axes) {
    all_clamp = all_clamp && axis.below == Outside::clamp && axis.above == Outside::clamp;
    some_error = some_error || axis.below == Outside::error || axis.above == Outside::error;
    lines.push_back(fmt::format("{} below {:.6g}: {}, above {:.6g}: {}", axis.name,
                                axis.nodes.front(), outside_text(axis.below), axis.nodes.back(),
                                outside_text(axis.above)));
  }
  if (some_error)
    lines.push_back("An error begins a millionth of its value beyond an end: single precision "
                    "misses ends by less.");
  return all_clamp ? std::vector<std::string>{} : lines;
}

std::string unchanged_states(const table::Table& table) {
  std::string others;
  for (const std::string& name : table.inputs())
    if (name != "sigma_n_MPa" && name != "sigma_f_MPa" && expr::symbols(table.combine).count(name))
      others += (others.empty() ? "" : ", ") + name;
  return others.empty() ? "stress and flow stress" : "stress, flow stress, " + others;
}

std::vector<std::string> outside_rule(const table::Table& table, const std::string& error_action) {
  std::vector<std::string> lines = outside_lines(table);
  if (lines.empty())
    return {"Outside the range the " + std::string(table.is_direct() ? "law" : "table") +
            "'s value at the nearest edge is used; " + unchanged_states(table) +
            " enter the formula unchanged."};
  lines.insert(lines.begin(), "Outside the range (error: " + error_action + "):");
  return lines;
}

std::string drift_text(const table::Table& table) {
  if (table.is_direct()) return "none but rounding, it is the law itself; measured in verify.json";
  const table::TableRecord& record = table.record;
  if (!record.worst_case_MPa)
    return "not measured here; see verify.json of the run that wrote this file";
  std::string text =
      fmt::format("{:.3g} MPa, the largest found over the whole range", *record.worst_case_MPa);
  if (record.proven_drift_MPa)
    text += fmt::format("; proven: nowhere above {:.3g} MPa", rounded_up(*record.proven_drift_MPa));
  if (table.drift_is_claimed) text += " (so says the table's file)";
  return text;
}

std::string origin_text(const table::Table& table) {
  const std::string origin = table.record.data_origin.value_or("");
  return origin.empty() ? "not stated" : origin;
}

std::string edge_text(const table::Table& table) {
  const char* const pressure = "sigma_n_MPa";
  const table::TableAxis* axis = table::find_axis(table, pressure);
  if (!axis || axis->below != Outside::clamp || axis->nodes.front() <= 0) return "";
  const double low = axis->nodes.front();
  std::vector<double> state;
  std::size_t at = 0;
  for (const std::string& name : table.inputs()) {
    if (name == pressure) at = state.size();
    const auto typical = typical_value(table, name);
    if (!typical) return "";
    state.push_back(*typical);
  }
  const table::TableFunction tau(table);
  state[at] = low;
  const double at_low = tau(state);
  state[at] = 0.001 * low;
  const double at_edge = tau(state);
  if (!(at_edge > 0.01 * at_low)) return "";
  return fmt::format("keeps {:.3g} MPa below {:.6g} MPa of contact normal stress, also at an edge "
                     "of the contact; the law itself there: [table.axes.{}] outside = \"law\"",
                     at_edge, low, pressure);
}

std::string comment_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '/' && !out.empty() && out.back() == '*') out += ' ';
    out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out;
}

std::vector<std::string> comment_lines(const std::vector<std::string>& texts, std::size_t width,
                                       std::string_view further) {
  std::vector<std::string> lines;
  for (const std::string& text : texts)
    for (std::string& line : wrap_text(comment_text(text), width, further))
      lines.push_back(std::move(line));
  return lines;
}

} // namespace frictab::codegen
