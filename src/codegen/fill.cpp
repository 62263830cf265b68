// Inputs, units, numbers and texts that the templates of every target are filled with.
#include "codegen/fill.h"

#include "codegen/layer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "data/meaning.h"
#include "data/quantity.h"
#include "table/bound.h"
#include "table/frictab_kernel.h"
#include "table/spline.h"
#include "table/states.h"

namespace frictab {

namespace {

std::string replace_ending(const std::string& name, std::string_view from, std::string_view to) {
  if (name.size() <= from.size() || name.substr(name.size() - from.size()) != from) return name;
  return name.substr(0, name.size() - from.size()) + std::string(to);
}

// A column's own name may hold anything; the prefix keeps it off keywords and generated names.
std::string identifier(const std::string& name) {
  std::string text = find_quantity(name) ? "" : "in_";
  for (const char c : name)
    text += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return text;
}

std::string argument_name(const InputArgument& input) {
  const std::string name = identifier(input.name);
  if (input.solver.same()) return name;
  if (input.unit == "MPa") return replace_ending(name, "_MPa", "_Pa");
  if (input.unit == "mm/s") return replace_ending(name, "_mm_s", "_m_s");
  if (input.unit == "mm") return replace_ending(name, "_mm", "_m");
  return name;
}

InputArgument argument(const Table& table, const std::string& name, std::string_view units) {
  InputArgument input;
  const Meaning meaning = meaning_of(name);
  input.name = name;
  input.unit = meaning.unit;
  input.meaning = meaning.text;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    if (table.axes[a].name != name) continue;
    input.axis = a;
    input.unit = table.axes[a].unit;
    if (!table.axes[a].long_name.empty()) input.meaning = table.axes[a].long_name;
  }
  if (find_quantity(name)) { // whatever the axis says
    input.unit = meaning.unit;
    input.meaning = meaning.text;
  }
  if (input.meaning == Meaning{}.text) input.meaning = name + " " + input.meaning;
  if (const auto& levels = table.record.input(name).levels) input.meaning = name + ": " + *levels;
  input.solver = solver_unit(input.unit, units);
  input.argument = argument_name(input);
  return input;
}

} // namespace

SolverUnit solver_unit(std::string_view canonical_unit, std::string_view units) {
  if (units != "mm-t-s" && units != "m-kg-s")
    throw InputError({}, fmt::format("unknown unit system '{}' in export.units", units),
                     "known: mm-t-s (MPa, mm/s, mm, N), m-kg-s (Pa, m/s, m, N)");
  if (units == "m-kg-s") {
    if (canonical_unit == "MPa") return {"Pa", 1, 1e6};
    if (canonical_unit == "mm/s") return {"m/s", 1e3, 1};
    if (canonical_unit == "mm") return {"m", 1e3, 1};
    // Work and power per area; a name may write the product either way.
    if (canonical_unit == "MPa mm") return {"Pa m", 1, 1e3};
    if (canonical_unit == "MPa*mm") return {"Pa*m", 1, 1e3};
    if (canonical_unit == "MPa mm/s") return {"Pa m/s", 1, 1e3};
    if (canonical_unit == "MPa*mm/s") return {"Pa*m/s", 1, 1e3};
  }
  return {std::string(canonical_unit), 1, 1};
}

std::vector<InputArgument> entry_arguments(const Table& table, std::string_view units) {
  std::vector<InputArgument> arguments;
  std::set<std::string> taken;
  const std::vector<std::string> needed = table.inputs();
  for (const Quantity& quantity : quantities())
    if (quantity.argument) arguments.push_back(argument(table, quantity.name, units));
  for (const std::string& name : needed) {
    const auto same = [&](const InputArgument& a) { return a.name == name; };
    const auto found = std::find_if(arguments.begin(), arguments.end(), same);
    if (found == arguments.end())
      arguments.push_back(argument(table, name, units)), arguments.back().used = true;
    else
      found->used = true;
  }
  for (InputArgument& a : arguments)
    while (!taken.insert(a.argument).second)
      a.argument += "_";
  return arguments;
}

std::optional<std::pair<double, double>> known_range(const Table& table, const std::string& name) {
  return table.range(name);
}

std::optional<double> typical_value(const Table& table, const std::string& name) {
  const auto range = known_range(table, name);
  if (!range) return std::nullopt;
  if (table.record.input(name).levels) return range->first; // the level whose factor is 1
  bool log = meaning_of(name).log_axis;
  for (const TableAxis& axis : table.axes)
    if (axis.name == name) log = axis.log;
  const auto [low, high] = *range;
  return log && low > 0 ? std::sqrt(low) * std::sqrt(high) : 0.5 * (low + high);
}

std::string edge_text(const Table& table) {
  const char* const pressure = "sigma_n_MPa";
  const TableAxis* axis = find_axis(table, pressure);
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
  const TableFunction tau(table);
  state[at] = low;
  const double at_low = tau(state);
  state[at] = 0.001 * low;
  const double at_edge = tau(state);
  if (!(at_edge > 0.01 * at_low)) return "";
  return fmt::format("keeps {:.3g} MPa below {:.6g} MPa of contact normal stress, also at an edge "
                     "of the contact; the law itself there: [table.axes.{}] outside = \"law\"",
                     at_edge, low, pressure);
}

std::size_t baked_numbers(const Table& table) {
  std::size_t numbers = table.nodes() + table.constants.size() + count_numbers(table.combine);
  // Nodes, 1/width, polynomials of the cells; of the law itself the two ends.
  const std::size_t per_node = table.is_direct() ? 1 : is_cubic(table) ? 18 : 2;
  for (const TableAxis& axis : table.axes)
    numbers += axis.nodes.size() * per_node;
  if (!table.extension) return numbers;
  const LayeredFormula law = split_layer(*table.extension);
  return numbers + (law.layer ? law.layer->numbers() : 0) + count_numbers(law.rest);
}

void check_table_size(const Table& table, std::size_t elsewhere, const std::string& remedy) {
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

void check_table(const Table& table) {
  FaultList faults;
  std::size_t nodes = 1;
  for (const TableAxis& axis : table.axes) {
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
  if (!table.is_direct() && !table.stored && nodes != table.value.size())
    faults.add({}, fmt::format("the table has {} values for {} nodes", table.value.size(), nodes));
  if (!std::all_of(table.value.begin(), table.value.end(),
                   [](double v) { return std::isfinite(v); }))
    faults.add({}, "the table holds values that are not finite");
  const bool extends = std::any_of(table.axes.begin(), table.axes.end(), [](const TableAxis& axis) {
    return axis.below == Outside::law || axis.above == Outside::law;
  });
  if ((extends || table.is_direct()) && !table.extension)
    faults.add({}, fmt::format("the table of {} does not hold the law's own formula", table.model),
               "tabulate again with outside = \"law\" in [table.axes]");
  faults.throw_if_any();
}

bool is_cubic(const Table& table) {
  return table.interpolation == Interpolation::cubic && !table.axes.empty();
}

std::vector<double> baked_values(const Table& table) {
  if (table.stored) { // linear always
    std::vector<double> values(table.stored->size());
    table.stored->read(0, values);
    return values;
  }
  if (!is_cubic(table)) return table.value;
  std::vector<SplineAxis> axes;
  for (const TableAxis& axis : table.axes)
    axes.push_back(spline_axis(axis));
  return spline_coefficients(axes, table.value);
}

std::string comment_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '/' && !out.empty() && out.back() == '*') out += ' ';
    out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out;
}

std::string c_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string fortran_number(double value) {
  std::string text = fmt::format("{}", value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text + (text.find('.') == std::string::npos ? ".0D0" : "D0");
  std::string mantissa = text.substr(0, e), exponent = text.substr(e + 1);
  if (mantissa.find('.') == std::string::npos) mantissa += ".0";
  if (exponent[0] == '+') exponent.erase(0, 1);
  return mantissa + "D" + exponent;
}

std::string range_text(const InputArgument& input, const Table& table) {
  const auto known = known_range(table, input.name);
  if (!known) return "no axis, any value";
  const SolverUnit& unit = input.solver;
  std::string text = fmt::format("{:.6g} .. {:.6g}", unit.from_canonical(known->first),
                                 unit.from_canonical(known->second));
  if (unit.name != "1") text += " " + unit.name;
  return input.axis ? text : text + " (no axis: any value, verified there)";
}

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

std::vector<std::string> outside_lines(const Table& table) {
  std::vector<std::string> lines;
  bool all_clamp = true;
  for (const TableAxis& axis : table.axes) {
    all_clamp = all_clamp && axis.below == Outside::clamp && axis.above == Outside::clamp;
    lines.push_back(fmt::format("{} below {:.6g}: {}, above {:.6g}: {}", axis.name,
                                axis.nodes.front(), outside_text(axis.below), axis.nodes.back(),
                                outside_text(axis.above)));
  }
  return all_clamp ? std::vector<std::string>{} : lines;
}

std::string drift_text(const Table& table) {
  if (table.is_direct()) return "none but rounding, it is the law itself; measured in verify.json";
  const TableRecord& record = table.record;
  if (!record.worst_case_MPa)
    return "not measured here; see verify.json of the run that wrote this file";
  std::string text =
      fmt::format("{:.3g} MPa, the largest found over the whole range", *record.worst_case_MPa);
  if (record.proven_drift_MPa)
    text += fmt::format("; proven: nowhere above {:.3g} MPa", rounded_up(*record.proven_drift_MPa));
  return text;
}

std::string origin_text(const Table& table) {
  const std::string origin = table.record.data_origin.value_or("");
  return origin.empty() ? "not stated" : origin;
}

std::string number_lines(const std::vector<std::string>& items, std::size_t width,
                         const std::string& indent) {
  std::string out, line = indent;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const std::string item = items[i] + (i + 1 < items.size() ? "," : "");
    const bool first = line.size() == indent.size();
    if (!first && line.size() + 1 + item.size() > width) {
      out += line + "\n";
      line = indent + item;
    } else {
      line += (first ? "" : " ") + item;
    }
  }
  return out + line;
}

std::vector<std::string> wrap_text(std::string_view text, std::size_t width) {
  std::vector<std::string> lines(1);
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    std::string word(text.substr(i, end - i));
    for (; word.size() > width; word.erase(0, width)) { // a formula without blanks
      if (!lines.back().empty()) lines.emplace_back();
      lines.back() = word.substr(0, width);
    }
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > width)
      lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    i = end + 1;
  }
  return lines;
}

} // namespace frictab
