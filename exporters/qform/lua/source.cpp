// Fills templates/qform/lua/frictab_qform.lua. Formulas are the statements of C: Lua has the same
// operators, and the functions are defined at the head of the file.
#include "source.h"

#include <algorithm>

#include <fmt/format.h>

#include "codegen/baked_table.h"
#include "codegen/entry_arguments.h"
#include "codegen/layer.h"
#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "codegen/template.h"
#include "core/text.h"
#include "table/outside.h"
#include "table/spline.h"

namespace frictab::qform::lua {

using expr::Language;
using namespace codegen;
using table::axis_ends;
using table::AxisEnds;
using table::Outside;
using table::Table;

namespace {

constexpr std::size_t most_locals = 120; // Lua has 200 of them in a function
constexpr std::size_t chunk_size = 8192; // constants of a Lua 5.1 function are limited as well

std::string number(double value) {
  const std::string text = c_number(value);
  return text[0] == '-' ? "(" + text + ")" : text; // "--" would be a comment
}

template <class Numbers> std::string block(const Numbers& numbers, std::size_t indent = 4) {
  std::vector<std::string> texts;
  for (const auto value : numbers)
    if constexpr (std::is_integral_v<std::remove_const_t<decltype(value)>>)
      texts.push_back(std::to_string(value));
    else
      texts.push_back(c_number(value));
  return number_lines(texts, 98, std::string(indent, ' '));
}

std::map<std::string, std::string> symbol_names(const Table& table) {
  std::map<std::string, std::string> rename{{"value", "value"}};
  const std::vector<std::string> inputs = table.inputs();
  for (std::size_t i = 0; i < inputs.size(); ++i)
    rename[inputs[i]] = fmt::format("x{}", i + 1);
  for (const auto& [name, value] : table.constants)
    rename[name] = number(value);
  return rename;
}

// Statements as lines of Lua; many of them keep their results in a table, not in locals.
struct Code {
  std::vector<std::string> lines;
  std::string result;
  bool in_table = false;
};
Code code_of(const expr::Expr& formula, const std::map<std::string, std::string>& rename,
             char name) {
  expr::Statements code = to_statements(formula, Language::c, rename, std::string(1, name));
  Code out;
  out.in_table = code.lines.size() > most_locals;
  if (out.in_table)
    code = to_statements(formula, Language::c, rename, fmt::format("{0}.{0}", name));
  for (const std::string& line : code.lines)
    out.lines.push_back((out.in_table ? "" : "local ") + line);
  out.result = code.result;
  return out;
}

std::vector<std::string> names_up_to(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(fmt::format("x{}", i + 1));
  return names;
}

std::vector<std::string> sides(const Table& table, Outside kind) {
  std::vector<std::string> tests;
  for (const AxisEnds& axis : axis_ends(table)) {
    const bool refuses = kind == Outside::error;
    const auto add = [&](const char* relation, double limit) {
      tests.push_back(fmt::format("x{} {} {}", axis.input + 1, relation, number(limit)));
    };
    if (axis.below == kind) add("<", refuses ? axis.refused_below : axis.low);
    if (axis.above == kind) add(">", refuses ? axis.refused_above : axis.high);
  }
  return tests;
}

// h1 stands for x1 where an axis is held at an end.
void add_held(TemplateValues& values, const Table& table,
              std::map<std::string, std::string>& rename) {
  std::vector<std::string> lines;
  for (const AxisEnds& axis : axis_ends(table)) {
    if (!expr::symbols(*table.extension).count(axis.name)) continue;
    if (axis.below == Outside::law && axis.above == Outside::law) continue;
    const std::string h = fmt::format("h{}", axis.input + 1);
    lines.push_back(fmt::format("local {} = {}", h, rename.at(axis.name)));
    const auto end = [&](const char* relation, double x) {
      lines.push_back(fmt::format("if {0} {1} {2} then {0} = {2} end", h, relation, number(x)));
    };
    if (axis.below != Outside::law) end("<", axis.low);
    if (axis.above != Outside::law) end(">", axis.high);
    rename[axis.name] = h;
  }
  values.lists["held"] = items(lines);
}

std::vector<std::string> add_layer(TemplateValues& values, const std::optional<UnitLayer>& layer,
                                   std::map<std::string, std::string>& rename) {
  const UnitLayer none;
  const UnitLayer& l = layer ? *layer : none;
  std::vector<std::string> before, names;
  Lines features;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    const expr::Statements code =
        to_statements(l.features[f], Language::c, rename, fmt::format("f{}_", f));
    for (const std::string& line : code.lines)
      before.push_back("local " + line);
    names.push_back(code.result);
    TemplateValues feature;
    feature.text["weights"] = block(l.weight[f]);
    features.push_back(feature);
  }
  for (std::size_t m = 0; m < l.outputs; ++m)
    rename[layer_output(m)] = fmt::format("net[{}]", m + 1);
  values.flags["has_layer"] = layer.has_value();
  values.lists["before"] = items(before);
  values.lists["features"] = features;
  values.text["feature_names"] = join(names, ", ");
  values.text["units"] = std::to_string(l.units());
  values.text["outputs"] = std::to_string(l.outputs);
  values.text["bias"] = block(l.bias, 2);
  values.text["gain"] = block(l.gain, 2);
  values.text["offset"] = block(l.offset, 2);
  return before;
}

// All statements, to see which functions they call.
std::string add_piece(TemplateValues& values, const Table& table) {
  const bool any = table.is_direct() || !sides(table, Outside::law).empty();
  values.flags["has_piece"] = any;
  values.flags["has_layer"] = values.flags["piece_table"] = false;
  values.text["quantity"] = models::quantity_name(table.quantity);
  for (const char* list : {"held", "before", "features", "piece"})
    values.lists[list];
  values.text["piece_result"] = "";
  auto rename = symbol_names(table);
  add_layer(values, std::nullopt, rename);
  if (!any) return "";
  add_held(values, table, rename);
  const LayeredFormula formula = split_layer(*table.extension);
  const std::vector<std::string> before = add_layer(values, formula.layer, rename);
  const Code code = code_of(formula.rest, rename, 'p');
  values.lists["piece"] = items(code.lines);
  values.flags["piece_table"] = code.in_table;
  values.text["piece_result"] = code.result;
  return join(before, "\n") + "\n" + join(code.lines, "\n");
}

void add_values(TemplateValues& values, const std::vector<double>& numbers) {
  const std::span<const double> all = numbers;
  Lines& chunks = values.lists["chunks"];
  for (std::size_t i = 0; i < all.size(); i += chunk_size) {
    TemplateValues chunk;
    chunk.text["text"] = block(all.subspan(i, std::min(chunk_size, all.size() - i)));
    chunks.push_back(chunk);
  }
}

void add_axes(TemplateValues& values, const Table& table) {
  const bool cubic = is_cubic(table);
  const auto rename = symbol_names(table);
  std::vector<std::string> strides, supports, weights, coordinates;
  long stride = static_cast<long>(table.nodes());
  bool logarithm = false;
  for (const table::TableAxis& axis : table.axes) {
    const std::size_t n = axis.nodes.size();
    strides.push_back(std::to_string(stride /= static_cast<long>(n)));
    supports.push_back(std::to_string(std::min<std::size_t>(n, 4)));
    weights.push_back(cubic ? "{}" : "0.0");
    const std::string& x = rename.at(axis.name);
    coordinates.push_back(axis.log ? "ft_log(" + x + ")" : x);
    logarithm = logarithm || axis.log;
    TemplateValues one;
    one.text["comment"] = comment_text((axis.log ? "ln " : "") + axis.name).substr(0, 90);
    one.text["nodes"] = block(axis.coordinates());
    const table::SplineAxis spline = cubic ? table::spline_axis(axis) : table::SplineAxis{};
    one.text["first"] = block(spline.first);
    one.text["basis"] = block(spline.basis);
    values.lists["axes"].push_back(one);
  }
  values.text["n_axes"] = std::to_string(table.axes.size());
  values.text["strides"] = join(strides, ", ");
  values.text["supports"] = join(supports, ", ");
  values.text["no_weights"] = join(weights, ", ");
  values.text["coordinates"] = join(coordinates, ", ");
  values.flags["uses_log"] = logarithm;
  add_values(values, baked_values(table));
}

// What stands where nothing is interpolated; empty where something is.
std::string only_value(const Table& table) {
  if (table.is_direct())
    return fmt::format("ft_piece({})", join(names_up_to(table.inputs().size()), ", "));
  if (!table.axes.empty()) return "";
  const std::string value = number(table.coordinate(table.value[0]));
  return table.log_value ? "exp(" + value + ")" : value;
}

void add_interpolation(TemplateValues& values, const Table& table) {
  const bool interpolates = !table.is_direct() && !table.axes.empty();
  values.flags["interpolates"] = interpolates;
  values.flags["cubic"] = is_cubic(table);
  values.flags["log_value"] = table.log_value;
  values.lists["axes"], values.lists["chunks"];
  values.flags["uses_log"] = false;
  for (const char* text : {"n_axes", "strides", "supports", "no_weights", "coordinates"})
    values.text[text] = "";
  values.text["value_comment"] = comment_text(
      fmt::format("{}{}{}, last axis fastest", is_cubic(table) ? "coefficients of " : "",
                  table.log_value ? "ln " : "", models::quantity_name(table.quantity)));
  values.text["only_value"] = only_value(table);
  if (interpolates) add_axes(values, table);
}

// What the solver gives under the argument's name, or what stands for it.
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
  const SolverUnit& unit = input.argument.solver;
  if (unit.times != 1) return input.argument.argument + " * " + c_number(unit.times);
  if (unit.over != 1) return input.argument.argument + " / " + c_number(unit.over);
  return input.argument.argument;
}

void add_entry(TemplateValues& values, const ExportRequest& request,
               const std::vector<SolverInput>& inputs) {
  const Table& table = request.table;
  std::vector<std::string> entry, arguments, converted, given;
  Lines call;
  const std::vector<InputArgument> all = entry_arguments(table, request.units);
  for (const InputArgument& argument : all) {
    entry.push_back(argument.argument);
    const std::string range = argument.used ? range_text(argument, table) : "not used by this law";
    for (const std::string& line :
         wrap_text(comment_text(fmt::format("{} ({}): {}; {}", argument.argument,
                                            argument.solver.name, argument.meaning, range)),
                   90))
      arguments.push_back(line.substr(0, 90));
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
  values.text["to_solver"] = stress.same() ? "" : " * " + c_number(stress.over);
  values.text["stress"] = stress.name;
  values.lists["arguments"] = items(arguments);
  values.lists["call"] = call;
  for (const AxisEnds& axis : table::all_ends(table)) {
    TemplateValues end;
    end.text = {{"value", canonical(inputs[axis.input])},
                {"low", number(axis.low)},
                {"high", number(axis.high)}};
    values.lists["ends"].push_back(end);
  }
  values.lists["ends"];
}

std::vector<std::string> about(const ExportRequest& request) {
  const Table& table = request.table;
  std::vector<std::string> out;
  const std::vector<std::string> texts = {
      fmt::format("Friction of the law \"{}\" {}, for QForm; generated by frictab {}", table.model,
                  table.is_direct() ? "by the law itself" : "from a table", FRICTAB_VERSION),
      "Data: " + origin_text(table), "Units: " + request.units,
      "Worst drift from the law: " + drift_text(table),
      "tau_R_MPa = " + expr::to_text(table.combine)};
  for (const std::string& text : texts) {
    std::string indent;
    for (const std::string& line : wrap_text(comment_text(text), 90)) {
      out.push_back(indent + line.substr(0, 90));
      indent = "  ";
    }
  }
  return out;
}

std::vector<std::string> outside(const Table& table) {
  std::vector<std::string> out = outside_lines(table);
  if (out.empty())
    return {"Outside the range the value at the nearest edge is used; stress and flow stress enter",
            "the formula unchanged."};
  for (std::string& line : out)
    line = comment_text(line).substr(0, 90);
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
  const Code formula = code_of(table.combine, symbol_names(table), 't');
  const std::string all = add_piece(values, table) + "\n" + join(formula.lines, "\n");
  const auto calls = [&](const char* name) { return all.find(name) != std::string::npos; };
  add_interpolation(values, table);
  values.flags["uses_pow"] = calls("pow(");
  values.flags["uses_min"] = calls("ft_min(");
  values.flags["uses_max"] = calls("ft_max(");
  values.flags["uses_where"] = calls("ft_where_le(");
  values.flags["uses_tanh"] = calls("tanh(");
  values.flags["uses_unit"] = calls("tanh(") || values.flags["has_layer"];
  values.flags["formula_table"] = formula.in_table;
  values.lists["formula"] = items(formula.lines);
  values.text["result"] = formula.result;
  const auto names = names_up_to(inputs.size());
  values.lists["states"] = items(names);
  values.text["parameters"] = join(names, ", ");
  values.lists["refusing"] = items(sides(table, Outside::error));
  values.lists["extending"] = table.is_direct() ? Lines{} : items(sides(table, Outside::law));
  values.lists["about"] = items(about(request));
  values.lists["outside"] = items(outside(table));
  add_entry(values, request, inputs);
  return render_template("qform/lua/frictab_qform.lua", values);
}

} // namespace frictab::qform::lua
