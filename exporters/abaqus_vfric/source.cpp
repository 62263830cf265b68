// Fills templates/abaqus_vfric/frictab_vfric.f.
#include "source.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "codegen/template.h"
#include "core/text.h"
#include "interpolation.h"
#include "parts.h"
#include "table/outside.h"

namespace frictab::abaqus_vfric {

namespace {

std::string number_or_nan(const VfricInput& input) {
  return input.fallback ? fortran_number(*input.fallback) : "ftqnan()";
}

// "/1.0D6": from the solver's unit to the canonical one.
std::string conversion(const SolverUnit& unit) {
  if (unit.times != 1) return "*" + fortran_number(unit.times);
  return unit.over != 1 ? "/" + fortran_number(unit.over) : "";
}

std::vector<std::string> about(const ExportRequest& request) {
  const Table& table = request.table;
  return {fmt::format("Law: {}", table.model), fmt::format("Data: {}", origin_text(table)),
          fmt::format("Units: {} (stress {}, speed {}, length {}, degC)", request.units,
                      solver_unit("MPa", request.units).name,
                      solver_unit("mm/s", request.units).name,
                      solver_unit("mm", request.units).name),
          fmt::format("Worst drift from the law: {}", drift_text(table)),
          fmt::format("tau_R_MPa = {}", to_text(table.combine))};
}

std::vector<std::string> states(const ExportRequest& request,
                                const std::vector<VfricInput>& inputs) {
  std::vector<std::string> lines;
  for (const VfricInput& input : inputs) {
    lines.push_back(fmt::format("{}: {}; {}", input.argument.argument, source_text(input),
                                range_text(input.argument, request.table)));
  }
  if (lines.empty()) lines.push_back("none");
  return lines;
}

std::vector<std::string> properties(const std::vector<VfricInput>& inputs) {
  std::vector<std::string> lines;
  for (const VfricInput& input : inputs) {
    if (input.property == 0) continue;
    const SolverUnit& unit = input.argument.solver;
    const std::string absent = input.fallback
                                   ? fmt::format("{:.6g}", unit.from_canonical(*input.fallback))
                                   : "not known: NaN until it is given";
    lines.push_back(fmt::format(
        "{} {}, {} ({}){}", input.property, input.argument.meaning, unit.name, absent,
        input.source == Source::temperature ? ", reference where the model has no temperatures"
                                            : ""));
  }
  if (lines.empty()) lines.push_back("none");
  return lines;
}

TemplateValues input_values(const VfricInput& input, std::size_t index) {
  TemplateValues values;
  const std::string convert = conversion(input.argument.solver);
  values.text = {{"index", std::to_string(index)},
                 {"comment", clip(input.argument.name + ": " + source_text(input))},
                 {"fallback", number_or_nan(input)},
                 {"property", std::to_string(input.property)},
                 {"field", std::to_string(input.field)},
                 {"convert", convert}};
  const auto is = [&](Source source) { return input.source == source; };
  values.flags = {
      {"is_pressure", is(Source::pressure)}, {"is_speed", is(Source::speed)},
      {"is_slip", is(Source::slip)},         {"is_temperature", is(Source::temperature)},
      {"is_property", is(Source::property)}, {"is_field", is(Source::field)},
      {"is_constant", is(Source::constant)}, {"converts", !convert.empty()}};
  return values;
}

void add_inputs(TemplateValues& values, const std::vector<VfricInput>& inputs) {
  Lines list;
  for (const VfricInput& input : inputs)
    list.push_back(input_values(input, list.size() + 1));
  if (list.empty()) { // x(1) exists even where the law needs no state
    VfricInput none;
    none.source = Source::constant;
    none.fallback = 0.0;
    list.push_back(input_values(none, 1));
    list[0].text["comment"] = "no state is needed";
  }
  values.text["n_x"] = std::to_string(list.size());
  values.flags["uses_slip"] = std::any_of(
      inputs.begin(), inputs.end(), [](const VfricInput& i) { return i.source == Source::slip; });
  values.flags["uses_unknown"] =
      std::any_of(inputs.begin(), inputs.end(), [](const VfricInput& i) { return !i.fallback; });
  values.lists["inputs"] = list;
}

// The direct form has no nodes.
std::vector<TableAxis> tabulated(const Table& table) {
  return table.is_direct() ? std::vector<TableAxis>{} : table.axes;
}

void add_coordinates(TemplateValues& values, const Table& table,
                     const std::map<std::string, std::string>& rename) {
  bool logarithm = false;
  Lines& axes = values.lists["axes"];
  for (const TableAxis& axis : tabulated(table)) {
    logarithm = logarithm || axis.log;
    const std::string& x = rename.at(axis.name);
    axes.emplace_back();
    axes.back().text["number"] = std::to_string(axes.size());
    axes.back().text["coordinate"] = axis.log ? "ftlog(" + x + ")" : x;
  }
  values.text["n_axes"] = std::to_string(table.axes.size());
  values.text["only_value"] = table.is_direct() ? "ftpiec(x)" : fortran_number(table.value[0]);
  values.text["value_comment"] =
      clip(fmt::format("{}{}{}, last axis fastest", is_cubic(table) ? "coefficients of " : "",
                       table.log_value ? "ln " : "", table.quantity));
  values.flags["has_axes"] = !table.axes.empty();
  values.flags["interpolates"] = !axes.empty();
  values.flags["uses_log"] = logarithm;
}

// What lies beyond the ends of the axes.
void add_outside(TemplateValues& values, const Table& table) {
  for (const AxisEnds& axis : axis_ends(table)) {
    TemplateValues one;
    one.text = {{"index", std::to_string(axis.input + 1)},
                {"low", fortran_number(axis.low)},
                {"high", fortran_number(axis.high)}};
    values.lists["ends"].push_back(one);
  }
  values.lists["ends"]; // also where there are none
  values.lists["extending"] = table.is_direct() ? Lines{} : sides(table, Outside::law);
  values.flags["refuses"] = !sides(table, Outside::error).empty();
  values.text["stop"] = values.flags["refuses"] ? stop(table) : "";
  values.flags["uses_unknown"] = values.flags["uses_unknown"] || values.flags["refuses"];
  values.text["depvar"] = table.axes.empty() ? "3" : "4";
  std::vector<std::string> lines = outside_lines(table);
  if (lines.empty())
    lines = {"Outside the range the " + std::string(table.is_direct() ? "law" : "table") +
             "'s value at the nearest edge is used; stress and flow stress enter the formula "
             "unchanged."};
  else
    lines.insert(lines.begin(), "Outside the range (error: XPLB_ABQERR ends the analysis):");
  values.lists["outside"] = comments(lines);
}

void add_formula(TemplateValues& values, const Table& table,
                 const std::map<std::string, std::string>& rename) {
  const Statements code = to_statements(table.combine, Language::fortran, rename);
  Lines statements, helpers;
  for (const std::string& line : code.lines)
    statements.push_back(item(fixed_form(line)));
  const bool has_piece = table.is_direct() || !sides(table, Outside::law).empty();
  const Piece law = has_piece ? piece(table) : Piece{};
  const std::vector<std::string> own = helpers_of(join(code.lines, "\n"));
  for (const std::string& helper : own)
    helpers.push_back(item(helper));
  for (const auto& [helper, flag] :
       {std::pair{"ftmin", "uses_min"}, {"ftmax", "uses_max"}, {"ftwhle", "uses_where"}})
    values.flags[flag] = std::count(own.begin(), own.end(), helper) > 0 ||
                         std::count(law.helpers.begin(), law.helpers.end(), helper) > 0;
  values.flags["has_piece"] = has_piece;
  values.text["piece"] = law.text;
  values.lists["statements"] = statements;
  values.lists["constants"] = constant_lines(table, table.combine);
  values.lists["helpers"] = helpers;
  values.lists["temporaries"] = declarations(code.temporaries);
  values.text["result"] = code.result;
  values.flags["log_value"] = table.log_value;
}

std::vector<std::string> argument_lines(const std::vector<VfricInput>& inputs) {
  std::vector<std::string> lines;
  for (const VfricInput& input : inputs)
    lines.push_back(
        fmt::format("x({}) {}, {}", lines.size() + 1, input.argument.name, input.argument.meaning));
  if (lines.empty()) lines.push_back("x(1) is not used");
  return lines;
}

} // namespace

std::string vfric_source(const ExportRequest& request, const std::vector<VfricInput>& inputs) {
  const Table& table = request.table;
  const SolverUnit stress = solver_unit("MPa", request.units);
  const auto rename = symbol_names(table);
  TemplateValues values;
  values.text = {{"version", FRICTAB_VERSION},
                 {"n_props", std::to_string(property_count(inputs))},
                 {"length", solver_unit("mm", request.units).name},
                 {"stress", stress.name},
                 {"from", table.is_direct() ? "by the law itself, no table" : "from a table"},
                 {"to_solver", stress.same() ? "" : "*" + fortran_number(stress.over)}};
  values.lists["about"] = comments(about(request));
  values.lists["states"] = comments(states(request, inputs));
  values.lists["properties"] = comments(properties(inputs));
  values.lists["source"] = comments({find_exporter("abaqus_vfric")->signature_source});
  values.lists["arguments"] = comments(argument_lines(inputs));
  add_inputs(values, inputs);
  add_coordinates(values, table, rename);
  add_interpolation(values, table);
  add_outside(values, table);
  add_formula(values, table, rename);
  return render_template("abaqus_vfric/frictab_vfric.f", values);
}

} // namespace frictab::abaqus_vfric
