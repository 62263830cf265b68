// Fills templates/abaqus_vfric/frictab_vfric.f.
#include "source.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "codegen/template.h"
#include "core/text.h"
#include "interpolation.h"

namespace frictab::abaqus_vfric {

namespace {

using Lines = std::vector<TemplateValues>;
constexpr std::size_t comment_width = 66; // columns 7..72

TemplateValues item(std::string text) {
  TemplateValues values;
  values.text["text"] = std::move(text);
  return values;
}

// Comment lines; what does not fit goes on, set in by two blanks.
Lines comments(const std::vector<std::string>& texts) {
  Lines lines;
  for (const std::string& text : texts) {
    const std::vector<std::string> pieces = wrap_text(comment_text(text), comment_width - 2);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      lines.push_back(item((i == 0 ? "" : "  ") + pieces[i].substr(0, comment_width - 2)));
  }
  return lines;
}

// The first line of a remark: what follows is in the head of the file.
std::string clip(const std::string& text) {
  return wrap_text(comment_text(text), comment_width - 4)[0].substr(0, comment_width - 4);
}

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

std::map<std::string, std::string> symbol_names(const Table& table) {
  std::map<std::string, std::string> rename{{"value", "val"}};
  const std::vector<std::string> inputs = table.inputs();
  for (std::size_t i = 0; i < inputs.size(); ++i)
    rename[inputs[i]] = fmt::format("x({})", i + 1);
  std::size_t c = 0;
  for (const auto& [name, value] : table.constants)
    rename[name] = fmt::format("c{}", ++c);
  return rename;
}

void add_coordinates(TemplateValues& values, const Table& table,
                     const std::map<std::string, std::string>& rename) {
  bool logarithm = false;
  Lines& axes = values.lists["axes"];
  for (const TableAxis& axis : table.axes) {
    logarithm = logarithm || axis.log;
    const std::string& x = rename.at(axis.name);
    axes.emplace_back();
    axes.back().text["number"] = std::to_string(axes.size());
    axes.back().text["coordinate"] = axis.log ? "ftlog(" + x + ")" : x;
  }
  values.text["n_axes"] = std::to_string(table.axes.size());
  values.text["only_value"] = fortran_number(table.value[0]);
  values.text["value_comment"] =
      clip(fmt::format("{}{}{}, last axis fastest", is_cubic(table) ? "coefficients of " : "",
                       table.log_value ? "ln " : "", table.quantity));
  values.flags["has_axes"] = !table.axes.empty();
  values.flags["uses_log"] = logarithm;
}

Lines declarations(const std::vector<std::string>& names) {
  constexpr std::size_t per_line = 8;
  Lines lines;
  for (std::size_t i = 0; i < names.size(); i += per_line) {
    const std::size_t end = std::min(names.size(), i + per_line);
    lines.push_back(
        item(fixed_form("double precision " + join(std::span(names).subspan(i, end - i), ", "))));
  }
  return lines;
}

void add_formula(TemplateValues& values, const Table& table,
                 const std::map<std::string, std::string>& rename) {
  const Statements code = to_statements(table.combine, Language::fortran, rename);
  const std::string text = join(code.lines, "\n");
  Lines statements, constants, helpers;
  for (const std::string& line : code.lines)
    statements.push_back(item(fixed_form(line)));
  const std::set<std::string> used = symbols(table.combine);
  for (const auto& [name, number] : table.constants) {
    if (!used.count(name)) continue;
    TemplateValues constant;
    constant.text = {{"index", rename.at(name).substr(1)},
                     {"comment", clip(name)},
                     {"value", fortran_number(number)}};
    constants.push_back(constant);
  }
  for (const auto& [helper, flag] :
       {std::pair{"ftmin", "uses_min"}, {"ftmax", "uses_max"}, {"ftwhle", "uses_where"}}) {
    values.flags[flag] = text.find(std::string(helper) + "(") != std::string::npos;
    if (values.flags[flag]) helpers.push_back(item(helper));
  }
  values.lists["statements"] = statements;
  values.lists["constants"] = constants;
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
                 {"to_solver", stress.same() ? "" : "*" + fortran_number(stress.over)}};
  values.lists["about"] = comments(about(request));
  values.lists["states"] = comments(states(request, inputs));
  values.lists["properties"] = comments(properties(inputs));
  values.lists["source"] = comments({find_exporter("abaqus_vfric")->signature_source});
  values.lists["arguments"] = comments(argument_lines(inputs));
  add_inputs(values, inputs);
  add_coordinates(values, table, rename);
  add_interpolation(values, table);
  add_formula(values, table, rename);
  return render_template("abaqus_vfric/frictab_vfric.f", values);
}

} // namespace frictab::abaqus_vfric
