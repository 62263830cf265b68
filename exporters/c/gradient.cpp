// Writes tau_R with its derivatives by every argument, in C.
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/entry_arguments.h"
#include "codegen/entry_text.h"
#include "codegen/number_text.h"
#include "codegen/values_file.h"
#include "core/text.h"
#include "parts.h"

namespace frictab::c_target {

using namespace codegen;
using table::Table;

namespace {

// Slopes of the value by its states, by name of the state.
using Slopes = std::map<std::string, std::string>;

Slopes add_states(TemplateValues& values, const Table& table,
                  const std::vector<InputArgument>& inputs, Variables& variables) {
  Slopes slopes;
  std::size_t used = 0, of_piece = 0;
  values.lists["through_value"];
  values.lists["of_piece"];
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (!inputs[i].used) continue;
    values.lists["used"][used++].text["place"] = std::to_string(i);
    if (!acts_through_value(table, inputs[i].name)) continue;
    const std::string& slope = slopes[inputs[i].name] =
        variables.slope(variables.name("value"), inputs[i].name);
    values.lists["through_value"].push_back(item(slope));
    if (!table.extension || !expr::symbols(*table.extension).count(inputs[i].name)) continue;
    values.lists["of_piece"].push_back(item(slope));
    values.lists["of_piece"].back().text["place"] = std::to_string(of_piece++);
  }
  values.flags["none_used"] = used == 0;
  values.text["n_by"] = std::to_string(std::max<std::size_t>(of_piece, 1));
  values.text["n_arguments"] = std::to_string(inputs.size());
  return slopes;
}

void add_axis_slopes(TemplateValues& values, const Table& table, const Variables& variables,
                     const Slopes& slopes) {
  Lines axes;
  for (const table::TableAxis& axis :
       table.is_direct() ? std::vector<table::TableAxis>{} : table.axes) {
    const std::string& x = variables.name(axis.name);
    TemplateValues one;
    one.text = {{"index", std::to_string(axes.size())},
                {"variable", x},
                {"slope", slopes.at(axis.name)},
                {"coordinate", axis.log ? "ft_log(" + x + ")" : x}};
    one.flags["log"] = axis.log;
    axes.push_back(one);
  }
  values.flags["interpolates"] = !axes.empty();
  values.flags["tabulated"] = !table.is_direct();
  values.flags["log_value"] = table.log_value;
  values.text["n_axes"] = std::to_string(axes.size());
  values.text["only_value"] = table.log_value ? "exp(ft_value[0])" : "ft_value[0]";
  values.text["interpolate"] =
      fmt::format("ft_{}_gradient_{}", is_cubic(table) ? "cubic" : "linear", axes.size());
  values.lists["axes"] = axes;
}

void add_formula(TemplateValues& values, const ExportRequest& request,
                 const std::vector<InputArgument>& inputs, Variables& variables,
                 const Slopes& slopes) {
  const Table& table = request.table;
  const SolverUnit stress = solver_unit("MPa", request.units);
  std::vector<std::string> states;
  for (const InputArgument& input : inputs)
    states.push_back(input.name);
  const std::vector<Wanted> wanted = tangent_formulas(table, "tau_R", states, variables);
  const Statements code = variables.statements(wanted);
  values.lists["statements"] = items(code.lines);
  values.text["result"] = in_units(code.results[0], request.units);
  const bool by_value = !wanted[1].formula.is_constant(0);
  values.lists["slopes"];
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const bool direct = !wanted[2 + i].formula.is_constant(0);
    const bool through = by_value && acts_through_value(table, inputs[i].name);
    if (!direct && !through) continue; // the derivative is 0
    std::string sum = direct ? code.results[2 + i] : "";
    if (through)
      sum +=
          fmt::format("{}{} * {}", direct ? " + " : "", code.results[1], slopes.at(inputs[i].name));
    const std::string factor = from_canonical_text(per(stress, inputs[i].solver), Notation::c);
    TemplateValues slope =
        item(factor.empty() || !direct || !through ? sum + factor : "(" + sum + ")" + factor);
    slope.text["place"] = std::to_string(i);
    values.lists["slopes"].push_back(slope);
  }
  if (by_value) return;
  if (!expr::symbols(table.combine).count("value"))
    values.lists["unused"].push_back(item(variables.name("value")));
  for (const auto& [state, slope] : slopes)
    values.lists["unused"].push_back(item(slope));
}

} // namespace

std::string gradient_functions(const ExportRequest& request,
                               const std::vector<InputArgument>& inputs) {
  const Table& table = request.table;
  Variables variables = variables_of(table, table.combine, inputs);
  const std::vector<std::string> extending = tests_of(table, variables, table::Outside::law);
  const bool has_piece = table.is_direct() || !extending.empty();
  TemplateValues values;
  add_state(values, table, inputs, variables);
  const Slopes slopes = add_states(values, table, inputs, variables);
  add_axis_slopes(values, table, variables, slopes);
  values.flags["in_file"] = values_in_file(request);
  values.lists["unused"] = items(unused_arguments(inputs));
  add_formula(values, request, inputs, variables, slopes);
  values.lists["refusing"] = items(tests_of(table, variables, table::Outside::error));
  values.flags["has_piece"] = has_piece;
  values.text["extending"] = join(extending, " ||\n");
  values.text["piece_gradient"] = has_piece ? piece_gradient(table, inputs) : "";
  values.text["piece_call"] = has_piece ? piece_gradient_call(table, inputs, variables) : "";
  values.offered = {"names"}; // used by the head of frictab_tau_R, which is not part of this text
  return render_part("c/frictab_gradient.c", values);
}

} // namespace frictab::c_target
