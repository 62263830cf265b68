// Fills templates/fortran/frictab_gradient.f.
#include "codegen/fortran_gradient.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/fixed_form.h"
#include "core/text.h"
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

// Adds tau, then dtau(i) = derivative at a fixed value plus the part through the value. Returns the
// helpers that are called.
std::vector<std::string> add_formula(TemplateValues& values, const table::Table& table) {
  const std::string tau = "tau";
  Variables variables(table, table.combine, Language::fortran);
  const std::vector<std::string> inputs = table.inputs();
  const std::vector<Wanted> wanted = tangent_formulas(table, tau, inputs, variables);
  const Statements code = variables.statements(wanted);
  const auto value_lines = static_cast<std::ptrdiff_t>(code.first_lines[0]);
  std::vector<std::string> statements(code.lines.begin(), code.lines.begin() + value_lines);
  for (const std::string& line : moved(code.results[0], tau))
    statements.push_back(line);
  std::vector<std::string> slopes(code.lines.begin() + value_lines, code.lines.end());
  const bool by_value = !wanted[1].formula.is_constant(0);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool direct = !wanted[2 + i].formula.is_constant(0),
               through = by_value && acts_through_value(table, inputs[i]);
    const std::string chain = wanted[1].formula.is_constant(1)
                                  ? fmt::format("by({})", i + 1)
                                  : fmt::format("{}*by({})", code.results[1], i + 1);
    slopes.push_back(fmt::format("dtau({}) = {}{}{}", i + 1,
                                 direct || !through ? code.results[2 + i] : "",
                                 direct && through ? " + " : "", through ? chain : ""));
  }
  if (inputs.empty()) slopes.push_back("dtau(1) = 0.0D0");
  values.lists["statements"] = fixed_lines(statements);
  values.lists["slopes"] = fixed_lines(slopes);
  values.text["value"] = variables.name("value");
  return add_declarations(values, table, variables, table.combine, code, tau);
}

} // namespace

Piece gradient_unit(const ExportRequest& request, const TemplateValues& core, Units units) {
  const table::Table& table = request.table;
  TemplateValues values;
  Piece out;
  out.helpers = add_formula(values, table);
  values.lists["axes"] = axes(table, core);
  values.lists["extending"] = core.lists.at("extending");
  values.lists["refusing"] = sides(table, table::Outside::error);
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
