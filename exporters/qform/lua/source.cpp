// Fills templates/qform/lua/frictab_qform.lua. Formulas are the statements of C: Lua has the same
// operators, and the head of the file defines the functions.
#include "source.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/entry_arguments.h"
#include "codegen/entry_text.h"
#include "codegen/layer_text.h"
#include "codegen/number_text.h"
#include "codegen/sides.h"
#include "codegen/table_text.h"
#include "codegen/variables.h"
#include "core/template.h"
#include "core/text.h"
#include "core/version.h"
#include "table/outside.h"
#include "table/spline.h"

namespace frictab::qform::lua {

using namespace codegen;
using table::AxisEnds;
using table::Outside;
using table::Table;

namespace {

// Lua allows 200 of them in a function.
constexpr std::size_t most_locals = 120;
// A Lua 5.1 function also has a limited number of constants.
constexpr std::size_t chunk_size = 8192;
constexpr std::size_t comment_width = 90;

std::string number(double value) {
  const std::string text = c_number(value);
  return text[0] == '-' ? "(" + text + ")" : text; // "--" would be a comment
}

// Returns the variables of a function with this formula, in which constants are written as numbers.
Variables variables_of(const Table& table, const expr::Expr& formula,
                       const std::set<std::string>& taken = {}) {
  Variables variables(table, formula, Language::c, {}, taken);
  for (const std::string& name : variables.constants())
    variables.set(name, number(table.constants.at(name)));
  return variables;
}

std::vector<std::string> names_of(const std::vector<std::string>& states,
                                  const Variables& variables) {
  std::vector<std::string> names;
  for (const std::string& state : states)
    names.push_back(variables.name(state));
  return names;
}

// Returns arguments broken into lines, which the template indents.
std::string arguments(const std::vector<std::string>& names) {
  return number_lines(names, 76, "");
}

// Returns the arguments of the law's own formula, with which the template calls it.
std::vector<std::string> piece_arguments(const Table& table, const Variables& variables) {
  return names_of(variables.states_of(*table.extension), variables);
}

// Statements as lines of Lua. If there are many, their results are kept in a table, not in locals.
struct Code {
  std::vector<std::string> lines;
  std::vector<std::string> results;
  std::vector<std::size_t> first_lines;
  bool in_table = false;
};
Code code_of(const std::vector<Wanted>& wanted, const Variables& variables) {
  const auto written = [&](const std::string& owner) {
    Variables own = variables;
    return own.statements(wanted, owner);
  };
  Statements code = written("");
  Code out;
  out.in_table = code.lines.size() > most_locals;
  if (out.in_table) code = written("steps.");
  for (const std::string& line : code.lines)
    out.lines.push_back((out.in_table ? "" : "local ") + line);
  out.results = code.results;
  out.first_lines = code.first_lines;
  return out;
}

std::vector<std::string> tests_of(const Table& table, const Variables& variables, Outside answer) {
  std::vector<std::string> tests;
  for (const Side& side : sides(table, answer))
    tests.push_back(
        fmt::format("{} {} {}", variables.name(side.axis), side.sign(), number(side.limit)));
  return tests;
}

// Clamps the state of an axis that is clamped at an end.
std::vector<std::string> held_lines(const Table& table, const Variables& variables) {
  std::vector<std::string> lines;
  for (const Side& side : clamped_sides(table))
    lines.push_back(fmt::format("if {0} {1} {2} then {0} = {2} end", variables.name(side.axis),
                                side.sign(), number(side.end)));
  return lines;
}

void add_layer_data(TemplateValues& values, const UnitLayer& l,
                    const std::vector<std::string>& names) {
  Lines features;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    features.push_back({.text = {{"weights", number_block(l.weight[f])}}});
  }
  values.lists["features"] = features;
  values.text["feature_names"] = join(names, ", ");
  values.text["units"] = std::to_string(l.units());
  values.text["outputs"] = std::to_string(l.outputs);
  values.text["bias"] = number_block(l.bias, 2);
  values.text["gain"] = number_block(l.gain, 2);
  values.text["offset"] = number_block(l.offset, 2);
}

// Adds ft_piece, the law's own formula. Returns all statements, to find the functions that they
// call.
std::string add_piece(TemplateValues& values, const Table& table) {
  const LayeredFormula formula = split_layer(*table.extension);
  const std::size_t features = formula.layer.features.size();
  Variables variables = variables_of(table, *table.extension, names_of_layer(formula.layer));
  const std::string value = variables.name("value");
  const std::vector<Wanted> wanted =
      layer_formulas(formula, value, {.output = "net[{}]", .first = 1, .slope = ""}, variables);
  const Code code = code_of(wanted, variables);
  const auto before = code.lines.begin() + static_cast<std::ptrdiff_t>(
                                               features > 0 ? code.first_lines[features - 1] : 0);
  values.flags["has_layer"] = formula.has_layer();
  add_layer_data(values, formula.layer, {code.results.begin(), code.results.end() - 1});
  values.lists["held"] = items(held_lines(table, variables));
  values.lists["before"] = items({code.lines.begin(), before});
  values.lists["piece"] = items({before, code.lines.end()});
  values.flags["piece_table"] = code.in_table;
  values.text["piece_result"] = code.results.back();
  values.text["piece_parameters"] = arguments(piece_arguments(table, variables));
  return join(code.lines, "\n");
}

void add_no_piece(TemplateValues& values) {
  values.flags["has_layer"] = values.flags["piece_table"] = false;
  for (const char* list : {"held", "before", "piece"})
    values.lists[list];
  add_layer_data(values, UnitLayer{}, {});
  values.text["piece_result"] = values.text["piece_parameters"] = "";
}

void add_values(TemplateValues& values, const std::vector<double>& numbers) {
  const std::span<const double> all = numbers;
  Lines& chunks = values.lists["chunks"];
  for (std::size_t i = 0; i < all.size(); i += chunk_size) {
    chunks.push_back(
        {.text = {{"text", number_block(all.subspan(i, std::min(chunk_size, all.size() - i)))}}});
  }
}

void add_axes(TemplateValues& values, const Table& table, const Variables& variables) {
  const bool cubic = is_cubic(table);
  std::vector<std::string> strides, supports, weights, coordinates;
  long stride = static_cast<long>(table.nodes());
  bool logarithm = false;
  for (const table::TableAxis& axis : table.axes) {
    const std::size_t n = axis.nodes.size();
    strides.push_back(std::to_string(stride /= static_cast<long>(n)));
    supports.push_back(std::to_string(std::min<std::size_t>(n, 4)));
    weights.push_back(cubic ? "{}" : "0.0");
    const std::string& x = variables.name(axis.name);
    coordinates.push_back(axis.log ? "ft_log(" + x + ")" : x);
    logarithm = logarithm || axis.log;
    TemplateValues one;
    one.text["comment"] = comment_text((axis.log ? "ln " : "") + axis.name).substr(0, 90);
    one.text["nodes"] = number_block(axis.coordinates());
    const table::SplineAxis spline = cubic ? table::spline_axis(axis) : table::SplineAxis{};
    one.text["first"] = number_block(spline.first);
    one.text["basis"] = number_block(spline.basis);
    values.lists["axes"].push_back(one);
  }
  values.text["n_axes"] = std::to_string(table.axes.size());
  values.text["strides"] = join(strides, ", ");
  values.text["supports"] = join(supports, ", ");
  values.text["no_weights"] = join(weights, ", ");
  values.text["coordinates"] = arguments(coordinates);
  values.flags["uses_log"] = logarithm;
  add_values(values, baked_values(table));
}

// Returns the value if nothing is interpolated; empty otherwise.
std::string only_value(const Table& table, const Variables& variables) {
  if (table.is_direct())
    return fmt::format("ft_piece({})", arguments(piece_arguments(table, variables)));
  if (!table.axes.empty()) return "";
  const std::string value = number(table.coordinate(table.value[0]));
  return table.log_value ? "exp(" + value + ")" : value;
}

void add_interpolation(TemplateValues& values, const Table& table, const Variables& variables) {
  const bool interpolates = !table.is_direct() && !table.axes.empty();
  values.flags["interpolates"] = interpolates;
  values.flags["cubic"] = is_cubic(table);
  values.flags["log_value"] = table.log_value;
  values.lists["axes"], values.lists["chunks"];
  values.flags["uses_log"] = false;
  for (const char* text : {"n_axes", "strides", "supports", "no_weights", "coordinates"})
    values.text[text] = "";
  values.text["value_comment"] = comment_text(baked_values_text(table, "coefficients of "));
  values.text["only_value"] = only_value(table, variables);
  if (interpolates) add_axes(values, table, variables);
}

// Returns the source of an argument: the solver's value, or its replacement.
std::string source_text(const SolverInput& input) {
  const InputArgument& argument = input.argument;
  if (input.source != Source::constant && input.source != Source::property)
    return argument.argument;
  const std::string value =
      input.fallback ? number(argument.solver.from_canonical(*input.fallback)) : "ft_nan";
  if (input.source == Source::constant) return value;
  return fmt::format("parameter(\"{}\", {})", argument.argument, value);
}

std::string canonical(const SolverInput& input) {
  return input.argument.argument + to_canonical_text(input.argument.solver, Notation::c);
}

void add_entry(TemplateValues& values, const ExportRequest& request,
               const std::vector<SolverInput>& inputs) {
  const Table& table = request.table;
  std::vector<std::string> entry, converted, given;
  Lines call;
  const std::vector<InputArgument> all = entry_arguments(table, request.units);
  for (const InputArgument& argument : all) {
    entry.push_back(argument.argument);
    const auto input = std::find_if(inputs.begin(), inputs.end(), [&](const SolverInput& i) {
      return i.argument.name == argument.name;
    });
    const std::string from = input == inputs.end() ? "nil" : source_text(*input);
    if (from == argument.argument) given.push_back(from);
    call.push_back(item(from + (&argument == &all.back() ? "" : ",")));
  }
  for (const SolverInput& input : inputs)
    converted.push_back(canonical(input));
  const SolverUnit stress = solver_unit("MPa", request.units);
  values.text["entry"] = number_lines(entry, 76, "");
  values.text["converted"] = number_lines(converted, 76, "");
  values.text["given"] = join(given, ", ");
  values.text["to_solver"] = from_canonical_text(stress, Notation::c);
  values.text["stress"] = stress.name;
  values.lists["arguments"] = items(comment_lines(argument_texts(request, all), comment_width));
  values.lists["call"] = call;
  for (const AxisEnds& axis : table::all_ends(table)) {
    values.lists["ends"].push_back({.text = {{"value", canonical(inputs[axis.input])},
                                             {"low", number(axis.low)},
                                             {"high", number(axis.high)}}});
  }
  values.lists["ends"];
}

std::vector<std::string> about(const ExportRequest& request) {
  const Table& table = request.table;
  return comment_lines(
      {fmt::format("Friction of the law \"{}\" {}, for QForm; generated by frictab {}", table.model,
                   table.is_direct() ? "by the law itself" : "from a table", tool_version()),
       "Data: " + origin_text(table), "Units: " + request.units.text(),
       "Worst drift from the law: " + drift_text(table),
       "tau_R_MPa = " + expr::to_text(table.combine)},
      comment_width, "  ");
}

std::vector<std::string> outside(const Table& table) {
  std::vector<std::string> out = outside_lines(table);
  if (out.empty())
    return comment_lines({"Outside the range the value at the nearest edge is used; " +
                          unchanged_states(table) + " enter the formula unchanged."},
                         comment_width);
  for (std::string& line : out)
    line = comment_text(line).substr(0, comment_width);
  out.insert(out.begin(), "Outside the range (error: NaN):");
  return out;
}

} // namespace

const SolverGives& gives() {
  static const SolverGives all = {
      .states = {{.state = "sigma_n_MPa", .text = "argument of FrictionStress (name recalled)"},
                 {.state = "v_rel_mm_s", .text = "argument of FrictionStress (name recalled)"},
                 {.state = "T_contact_C", .text = "argument of FrictionStress (name recalled)"},
                 {.state = "strain", .text = "argument of FrictionStress (name recalled)"}},
      .property = {.text = "QForm parameter @{property}"}};
  return all;
}

std::string lua_source(const ExportRequest& request, const std::vector<SolverInput>& inputs) {
  const Table& table = request.table;
  TemplateValues values;
  const Variables variables = variables_of(table, table.combine);
  const Code formula = code_of({{table.combine, "tau_R"}}, variables);
  const std::vector<std::string> extending =
      table.is_direct() ? std::vector<std::string>{} : tests_of(table, variables, Outside::law);
  std::string all = join(formula.lines, "\n") + "\n";
  values.flags["has_piece"] = table.is_direct() || !extending.empty();
  values.text["quantity"] = models::quantity_name(table.quantity);
  if (values.flags["has_piece"])
    all += add_piece(values, table);
  else
    add_no_piece(values);
  const auto calls = [&](const char* name) { return all.find(name) != std::string::npos; };
  add_interpolation(values, table, variables);
  values.flags["uses_pow"] = calls("pow(");
  values.flags["uses_min"] = calls("ft_min(");
  values.flags["uses_max"] = calls("ft_max(");
  values.flags["uses_where"] = calls("ft_where_le(");
  values.flags["uses_tanh"] = calls("tanh(");
  values.flags["uses_unit"] = calls("tanh(") || values.flags["has_layer"];
  values.flags["formula_table"] = formula.in_table;
  values.lists["formula"] = items(formula.lines);
  values.text["result"] = formula.results[0];
  values.text["value"] = variables.name("value");
  const std::vector<std::string> names = names_of(table.inputs(), variables);
  values.lists["states"] = items(names);
  values.text["parameters"] = arguments(names);
  values.lists["refusing"] = items(tests_of(table, variables, Outside::error));
  values.flags["extends"] = !extending.empty();
  values.text["extending"] = join(extending, " or\n");
  values.text["piece_call"] =
      extending.empty() ? "" : "ft_piece(" + arguments(piece_arguments(table, variables)) + ")";
  values.lists["about"] = items(about(request));
  values.lists["outside"] = items(outside(table));
  add_entry(values, request, inputs);
  return render_template("qform/lua/frictab_qform.lua", values);
}

} // namespace frictab::qform::lua
