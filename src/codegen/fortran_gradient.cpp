// Fills templates/fortran/frictab_gradient.f.
#include "codegen/fortran_gradient.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/fixed_form.h"
#include "core/text.h"
#include "expr/derivative.h"
#include "table/outside.h"

namespace frictab::codegen::fortran {

namespace {

// Returns the coordinates of the tabulated axes, and the states they are computed from.
Lines axes(const table::Table& table, const TemplateValues& core) {
  Lines out;
  const std::vector<table::AxisEnds> ends = table::axis_ends(table);
  for (const TemplateValues& axis : core.lists.at("axes")) {
    TemplateValues one;
    one.text = {{"number", axis.text.at("number")},
                {"coordinate", axis.text.at("coordinate")},
                {"input", std::to_string(ends[out.size()].input + 1)}};
    one.flags["log"] = table.axes[out.size()].log;
    out.push_back(one);
  }
  return out;
}

// True for the states that may change the value inside the formula.
std::vector<bool> steps_after_value(const table::Table& table) {
  std::vector<bool> out;
  for (const std::string& name : table.inputs())
    out.push_back((table.extension && expr::symbols(*table.extension).count(name)) ||
                  std::any_of(table.axes.begin(), table.axes.end(),
                              [&](const table::TableAxis& axis) { return axis.name == name; }));
  return out;
}

// Adds tau, then dtau(i) = derivative at a fixed value plus the part through the value.
void add_formula(TemplateValues& values, const table::Table& table,
                 std::vector<std::string>& helpers) {
  const std::string tau = "tau";
  Variables variables(table, table.combine, Language::fortran);
  const std::vector<std::string> inputs = table.inputs();
  const std::vector<bool> behind = steps_after_value(table);
  // The slope is needed only if some state changes the value.
  const bool changes = std::count(behind.begin(), behind.end(), true) > 0;
  std::vector<Wanted> wanted{{table.combine, tau},
                             {changes ? derivative(table.combine, "value") : expr::Expr(0.0),
                              variables.slope(tau, "value")}};
  for (const std::string& state : inputs)
    wanted.push_back({derivative(table.combine, state), variables.slope(tau, state)});
  const Statements code = variables.statements(wanted);
  const auto value_lines = static_cast<std::ptrdiff_t>(code.first_lines[0]);
  std::vector<std::string> statements(code.lines.begin(), code.lines.begin() + value_lines);
  for (const std::string& line : moved(code.results[0], tau))
    statements.push_back(line);
  std::vector<std::string> slopes(code.lines.begin() + value_lines, code.lines.end());
  const bool by_value = !wanted[1].formula.is_constant(0);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool direct = !wanted[2 + i].formula.is_constant(0), through = by_value && behind[i];
    const std::string chain = wanted[1].formula.is_constant(1)
                                  ? fmt::format("by({})", i + 1)
                                  : fmt::format("{}*by({})", code.results[1], i + 1);
    slopes.push_back(fmt::format("dtau({}) = {}{}{}", i + 1,
                                 direct || !through ? code.results[2 + i] : "",
                                 direct && through ? " + " : "", through ? chain : ""));
  }
  if (inputs.empty()) slopes.push_back("dtau(1) = 0.0D0");
  std::vector<std::string> names;
  values.lists["states"] = fixed_lines(states_from_x(table, variables, table.combine, names));
  names.insert(names.end(), code.names.begin(), code.names.end());
  std::erase(names, tau);
  values.lists["statements"] = fixed_lines(statements);
  values.lists["slopes"] = fixed_lines(slopes);
  values.lists["variables"] = declarations(names);
  values.lists["constants"] = constant_lines(table, variables);
  values.text["value"] = variables.name("value");
  helpers = helpers_of(join(code.lines, "\n"));
}

} // namespace

Piece gradient_unit(const ExportRequest& request, const TemplateValues& core, Units units) {
  const table::Table& table = request.table;
  TemplateValues values;
  Piece out;
  add_formula(values, table, out.helpers);
  values.lists["axes"] = axes(table, core);
  values.lists["extending"] = core.lists.at("extending");
  values.lists["refusing"] = sides(table, table::Outside::error);
  values.lists["helpers"] = items(out.helpers);
  for (const char* name : {"n_x", "n_axes", "only_value", "pure_tau"})
    values.text[name] = core.text.at(name);
  const bool refuses = !values.lists["refusing"].empty();
  const bool file = core.flags.at("in_file");
  const bool extends = !values.lists["extending"].empty();
  values.text["refused_text"] = refuses ? " or a side refuses" : "";
  values.flags = {{"has_by", table.is_direct() || !table.axes.empty()},
                  {"interpolates", core.flags.at("interpolates")},
                  {"uses_log", core.flags.at("uses_log")},
                  {"makes_nan", refuses || file},
                  {"in_file", file},
                  {"extends", extends},
                  {"has_piece", table.is_direct()},
                  {"log_value", table.log_value}};
  values.text["wish"] = units == Units::external ? ", .true." : "";
  add_units(values, units);
  out.text = render_part("fortran/frictab_gradient.f", values);
  return out;
}

} // namespace frictab::codegen::fortran
