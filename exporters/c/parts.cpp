// Writes the parts of the C sources that table and direct form share.
#include "parts.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/entry_text.h"
#include "codegen/number_text.h"
#include "codegen/prefix.h"
#include "codegen/sides.h"
#include "codegen/table_text.h"
#include "core/text.h"
#include "core/version.h"
#include "table/outside.h"

namespace frictab::c_target {

using expr::Expr;
using expr::symbols;
using namespace codegen;
using table::Outside;
using table::Table;

std::vector<std::string> parameters(const std::vector<InputArgument>& inputs,
                                    std::string_view type) {
  std::vector<std::string> pieces;
  for (const InputArgument& input : inputs)
    pieces.push_back(fmt::format("{} {}", type, input.argument));
  return pieces;
}

std::string lines(const std::vector<std::string>& pieces) {
  return number_lines(pieces, 90, "");
}

std::string canonical(const InputArgument& input, const std::string& element) {
  return input.argument + element + to_canonical_text(input.solver, Notation::c);
}

std::string in_units(const std::string& stress, const SolverUnits& units) {
  return stress + from_canonical_text(solver_unit("MPa", units), Notation::c);
}

Variables variables_of(const Table& table, const Expr& formula,
                       const std::vector<InputArgument>& inputs,
                       const std::set<std::string>& taken) {
  std::map<std::string, std::string> given;
  std::set<std::string> all = taken;
  for (const InputArgument& input : inputs) {
    all.insert(lower_case(input.argument));
    if (input.solver.same()) given[input.name] = input.argument;
  }
  return Variables(table, formula, Language::c, given, all);
}

std::vector<std::string> piece_states(const Table& table, const std::vector<InputArgument>& inputs,
                                      const Variables& variables) {
  const std::set<std::string> used = symbols(*table.extension);
  std::vector<std::string> states;
  for (const InputArgument& input : inputs)
    if (used.count(input.name)) states.push_back(variables.name(input.name));
  return states;
}

Lines constants_of(const Table& table, const Variables& variables) {
  Lines constants;
  for (const std::string& name : variables.constants()) {
    TemplateValues constant;
    constant.text = {{"name", variables.name(name)},
                     {"value", c_number(table.constants.at(name))},
                     {"comment", comment_text(name)}};
    constant.flags["renamed"] = variables.name(name) != name;
    constants.push_back(constant);
  }
  return constants;
}

std::vector<std::string> tests_of(const Table& table, const Variables& variables, Outside answer) {
  std::vector<std::string> tests;
  for (const Side& side : sides(table, answer))
    tests.push_back(
        fmt::format("{} {} {}", variables.name(side.axis), side.sign(), c_number(side.limit)));
  return tests;
}

void add_state(TemplateValues& values, const Table& table, const std::vector<InputArgument>& inputs,
               const Variables& variables) {
  Lines used;
  std::vector<std::string> names, arrays;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    names.push_back(inputs[i].argument);
    arrays.push_back(inputs[i].used ? inputs[i].argument + "[i]" : "0.0");
    if (!inputs[i].used) continue;
    TemplateValues input;
    input.text = {{"name", variables.name(inputs[i].name)}, {"canonical", canonical(inputs[i])}};
    input.flags["converted"] = !inputs[i].solver.same();
    used.push_back(input);
  }
  values.lists["used"] = used;
  values.lists["constants"] = constants_of(table, variables);
  values.text["value"] = variables.name("value");
  values.lists["unused_arrays"] = items(unused_arguments(inputs));
  values.text["parameters"] = lines(parameters(inputs, "double"));
  values.text["arrays"] = lines(parameters(inputs, "const double*"));
  values.text["names"] = lines(names);
  values.text["items"] = lines(arrays);
}

std::string add_tau_R(TemplateValues& values, const ExportRequest& request,
                      const std::vector<InputArgument>& inputs, Variables& variables) {
  const Table& table = request.table;
  const Statements code = variables.statements({{table.combine, "tau_R"}});
  values.lists["statements"] = items(code.lines);
  values.text["result"] = in_units(code.results[0], request.units);
  values.lists["refusing"] = items(tests_of(table, variables, Outside::error));
  values.lists["unused"] = items(unused_arguments(inputs));
  if (!symbols(table.combine).count("value"))
    values.lists["unused"].push_back(item(variables.name("value")));
  return join(code.lines, "\n");
}

std::string value_comment(const Table& table) {
  return comment_text(baked_values_text(table, "spline coefficients of "));
}

std::string helpers(const std::string& text) {
  const auto calls = [&](const char* helper) { return text.find(helper) != std::string::npos; };
  return render_part("c/frictab_helpers.c", {.flags = {{"uses_min", calls("ft_min(")},
                                                       {"uses_max", calls("ft_max(")},
                                                       {"uses_where", calls("ft_where_le(")}}});
}

namespace {

std::string call_of(const std::string& function, const std::vector<std::string>& arguments) {
  const std::string set_in(8, ' ');
  return function + "(" + number_lines(arguments, 80, set_in).substr(set_in.size()) + ")";
}

} // namespace

std::string piece_call(const Table& table, const std::vector<InputArgument>& inputs,
                       const Variables& variables) {
  return call_of("ft_piece", piece_states(table, inputs, variables));
}

std::string piece_gradient_call(const Table& table, const std::vector<InputArgument>& inputs,
                                const Variables& variables) {
  std::vector<std::string> arguments = piece_states(table, inputs, variables);
  arguments.push_back("by");
  return call_of("ft_piece_gradient", arguments);
}

namespace {

// Lists the ends of axes and clamped inputs, by the numbers of their bits.
Lines range_ends(const Table& table, const std::vector<InputArgument>& inputs) {
  Lines ends;
  for (const table::AxisEnds& end : table::all_ends(table)) {
    const InputArgument& input = argument_named(inputs, end.name);
    const std::size_t number = ends.size();
    ends.push_back({.text = {{"canonical", canonical(input, "")},
                             {"element", canonical(input, "[i]")},
                             {"name", comment_text(end.name)},
                             {"low", c_number(end.low)},
                             {"high", c_number(end.high)},
                             {"bit", std::to_string(1u << number)},
                             {"first", std::to_string(2 * number)},
                             {"second", std::to_string(2 * number + 1)}}});
  }
  return ends;
}

} // namespace

std::string outside_functions(const Table& table, const std::vector<InputArgument>& inputs) {
  TemplateValues values;
  values.text["parameters"] = lines(parameters(inputs, "double"));
  values.text["arrays"] = lines(parameters(inputs, "const double*"));
  values.lists["without_range"] = items(without_range(table, inputs));
  values.lists["ends"] = range_ends(table, inputs);
  values.flags["has_ends"] = !values.lists["ends"].empty();
  return render_part("c/frictab_outside.c", values);
}

std::string direct_source(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  const Table& table = request.table;
  Variables variables = variables_of(table, table.combine, inputs);
  TemplateValues values;
  values.flags["in_file"] = false;
  add_state(values, table, inputs, variables);
  const std::string law = piece(table, inputs);
  const std::string gradient = gradient_functions(request, inputs);
  const std::string formula = add_tau_R(values, request, inputs, variables);
  values.text["helpers"] = helpers(law + formula + gradient);
  values.text["model"] = comment_text(table.model);
  values.text["version"] = tool_version();
  values.text["piece"] = law;
  values.text["piece_call"] = piece_call(table, inputs, variables);
  values.text["outside"] = outside_functions(table, inputs);
  values.text["gradient"] = gradient;
  return render_template("c/frictab_direct.c", values);
}

} // namespace frictab::c_target
