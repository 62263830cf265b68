// Fills the templates of the kernel in single precision. What the law's formulas need is written as
// for double precision and turned into float (codegen/single_precision.h); the look-up is a text of
// its own, which device code can take: no pointers to the table, which lies in other memories
// there, and a search without branches.
#include "single.h"

#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "codegen/baked_table.h"
#include "codegen/entry_text.h"
#include "codegen/number_text.h"
#include "codegen/single_precision.h"
#include "codegen/table_text.h"
#include "core/error.h"
#include "core/text.h"
#include "core/version.h"
#include "parts.h"
#include "table/bound.h"
#include "table/outside.h"
#include "table/spline.h"

namespace frictab::c_target {

using namespace codegen;
using table::Table;

namespace {

std::string block(const std::vector<std::string>& texts) {
  return number_lines(texts, 98, "    ");
}

std::string float_block(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers)
    texts.push_back(single_number(number));
  return block(texts);
}

std::string int_block(const std::vector<int>& numbers) {
  std::vector<std::string> texts;
  for (const int number : numbers)
    texts.push_back(std::to_string(number));
  return block(texts);
}

std::vector<double> single_nodes(const table::TableAxis& axis) {
  std::vector<double> nodes;
  for (const double u : axis.coordinates())
    nodes.push_back(static_cast<float>(u));
  return nodes;
}

void check_nodes(const table::TableAxis& axis) {
  const std::vector<double> nodes = single_nodes(axis);
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (nodes[i] <= nodes[i - 1])
      throw InputError({},
                       fmt::format("two nodes of the table's axis '{}', {} and {}, are the same in "
                                   "single precision",
                                   axis.name, axis.nodes[i - 1], axis.nodes[i]),
                       "a wider range of the axis, or export.options.precision = \"double\"");
}

std::vector<double> per_cell(const std::vector<double>& nodes) {
  std::vector<double> out;
  for (std::size_t i = 1; i < nodes.size(); ++i)
    out.push_back(1 / (nodes[i] - nodes[i - 1]));
  return out;
}

// Steps of the values from node to node along each axis.
std::vector<std::size_t> strides(const Table& table) {
  std::vector<std::size_t> out(table.axes.size(), 1);
  for (std::size_t a = out.size(); a-- > 1;)
    out[a - 1] = out[a] * table.axes[a].nodes.size();
  return out;
}

std::string times(std::size_t factor) {
  return factor == 1 ? "" : fmt::format(" * {}", factor);
}

// Steps of the search in so many cells: half of what is left, until one is.
std::vector<std::string> search_steps(std::size_t cells, std::size_t axis) {
  std::vector<std::string> out;
  for (; cells > 1; cells -= cells / 2)
    out.push_back(
        fmt::format("cell += (u >= ft_u{}[cell + {}]) * {};", axis, cells / 2, cells / 2));
  return out;
}

TemplateValues single_axis(const table::TableAxis& axis, std::size_t index) {
  const std::vector<double> nodes = single_nodes(axis);
  const table::SplineAxis spline = table::spline_axis(axis);
  TemplateValues values;
  values.text = {{"comment", comment_text(fmt::format("axis {}: {}{}", index, axis.log ? "ln " : "",
                                                      axis.name))},
                 {"index", std::to_string(index)},
                 {"nodes", std::to_string(nodes.size())},
                 {"cells", std::to_string(nodes.size() - 1)},
                 {"values", float_block(nodes)},
                 {"per_cell", float_block(per_cell(nodes))},
                 {"first", int_block(spline.first)},
                 {"n_basis", std::to_string(spline.basis.size())},
                 {"basis", float_block(spline.basis)}};
  values.lists["steps"] = items(search_steps(nodes.size() - 1, index));
  return values;
}

// Of the corners along all axes but the first, the last axis fastest.
std::vector<std::size_t> corners(const std::vector<std::size_t>& stride) {
  std::vector<std::size_t> out{0};
  for (std::size_t a = 1; a < stride.size(); ++a) {
    std::vector<std::size_t> further;
    for (const std::size_t corner : out)
      for (const std::size_t step : {std::size_t{0}, stride[a]})
        further.push_back(corner + step);
    out = further;
  }
  return out;
}

void add_linear(TemplateValues& values, const Table& table) {
  const std::vector<std::size_t> stride = strides(table);
  std::vector<std::string> weights, at;
  for (std::size_t a = 0; a < stride.size(); ++a) {
    weights.push_back(fmt::format("w{}", a));
    at.push_back(fmt::format("ft_cell{0}(u{0}, &w{0}){1}", a, times(stride[a])));
  }
  const std::vector<std::size_t> lower = corners(stride);
  for (const std::size_t corner : lower) {
    TemplateValues pair;
    pair.text = {{"number", std::to_string(values.lists["corners"].size())},
                 {"lower", std::to_string(corner)},
                 {"upper", std::to_string(corner + stride[0])}};
    values.lists["corners"].push_back(pair);
  }
  values.text["n_corners"] = std::to_string(lower.size());
  values.text["weights"] = join(weights, ", ");
  values.text["first_corner"] = join(at, " +\n                 ");
  values.lists["inner"];
  std::size_t half = lower.size();
  for (std::size_t a = 1; a < stride.size(); ++a) {
    TemplateValues axis;
    axis.text = {{"index", std::to_string(a)}, {"half", std::to_string(half /= 2)}};
    values.lists["inner"].push_back(axis);
  }
}

// "w2[0] * ft_value[a2 + j] + w2[1] * ft_value[a2 + 9 + j] + ...": along axis a.
std::string spline_row(const Table& table, std::size_t a, std::size_t stride) {
  std::vector<std::string> terms;
  for (std::size_t i = 0; i < std::min<std::size_t>(table.axes[a].nodes.size(), 4); ++i)
    terms.push_back(i == 0 ? fmt::format("w{0}[0] * ft_value[a{0} + j]", a)
                           : fmt::format("w{0}[{1}] * ft_value[a{0} + {2} + j]", a, i, i * stride));
  return join(terms, " + ");
}

// Over the splines that are not zero in the cell: a loop in a loop for each axis but the last two;
// the 4 coefficients along the last one are summed side by side.
std::vector<std::string> spline_sums(const Table& table, const std::vector<std::size_t>& stride) {
  if (stride.size() == 1) return {"  for (j = 0; j < 4; ++j) s0[j] = ft_value[a0 + j];"};
  std::vector<std::string> out;
  const std::size_t loops = stride.size() - 2;
  const auto add = [&](std::size_t depth, const std::string& text) {
    out.push_back(std::string(2 * depth + 2, ' ') + text);
  };
  for (std::size_t a = 0; a < loops; ++a) {
    const std::size_t support = std::min<std::size_t>(table.axes[a].nodes.size(), 4);
    add(a, fmt::format("for (j = 0; j < 4; ++j) s{}[j] = 0.0f;", a));
    add(a, fmt::format("for (j{0} = 0; j{0} < {1}; ++j{0}) {{", a, support));
    add(a + 1, fmt::format("const int a{} = a{} + j{} * {};", a + 1, a, a, stride[a]));
  }
  add(loops, "for (j = 0; j < 4; ++j)");
  add(loops + 1, fmt::format("s{}[j] =", loops));
  for (const std::string& text : wrap_text(spline_row(table, loops, stride[loops]) + ";", 70))
    add(loops + 3, text);
  for (std::size_t a = loops; a-- > 0;) {
    add(a + 1, fmt::format("for (j = 0; j < 4; ++j) s{0}[j] += w{0}[j{0}] * s{1}[j];", a, a + 1));
    add(a, "}");
  }
  return out;
}

void add_cubic(TemplateValues& values, const Table& table) {
  const std::vector<std::size_t> stride = strides(table);
  std::vector<std::string> at, counters{"j"}, sums;
  for (std::size_t a = 0; a < stride.size(); ++a) {
    at.push_back(fmt::format("ft_first{0}[cell{0}]{1}", a, times(stride[a])));
    if (a + 2 < stride.size()) counters.push_back(fmt::format("j{}", a));
    if (a == 0 || a + 1 < stride.size()) sums.push_back(fmt::format("s{}[4]", a));
  }
  values.text["first_coefficient"] = join(at, " +\n                 ");
  values.text["counters"] = join(counters, ", ");
  values.text["sum_arrays"] = join(sums, ", ");
  values.text["last"] = std::to_string(stride.size() - 1);
  values.lists["sums"] = items(spline_sums(table, stride));
}

// A logarithm is taken of nothing below the axis, where there may be none.
std::string coordinate(const table::TableAxis& axis, const std::string& x) {
  if (!axis.log) return x;
  return fmt::format("log({0} < {1} ? {1} : {0})", x, c_number(axis.nodes.front()));
}

void add_look_up(TemplateValues& values, const Table& table, const Variables& variables) {
  std::vector<std::string> parameters, coordinates;
  for (std::size_t a = 0; a < table.axes.size(); ++a) {
    values.lists["axes"].push_back(single_axis(table.axes[a], a));
    parameters.push_back(fmt::format("float u{}", a));
    coordinates.push_back(
        in_single_precision(coordinate(table.axes[a], variables.name(table.axes[a].name))));
  }
  const std::vector<double> numbers = baked_values(table);
  values.text["value_comment"] = value_comment(table);
  values.text["n_values"] = std::to_string(numbers.size());
  values.text["values"] = float_block(numbers);
  values.text["parameters_u"] = join(parameters, ", ");
  values.text["coordinates"] = lines(coordinates);
  if (is_cubic(table))
    add_cubic(values, table);
  else if (!table.axes.empty())
    add_linear(values, table);
}

// As parts.cpp fills them for double precision, in float.
void turn_single(TemplateValues& values) {
  for (const char* name :
       {"parameters", "arrays", "items", "result", "piece", "helpers", "extending"})
    values.text[name] = in_single_precision(values.text[name]);
  for (const char* list : {"used", "constants", "statements", "refusing"})
    for (TemplateValues& one : values.lists[list])
      for (const char* name : {"canonical", "value", "text"})
        if (const auto text = one.text.find(name); text != one.text.end())
          text->second = in_single_precision(text->second);
}

const Scope device_scope{"FT_FUNCTION", "FT_DATA", false, "1e-6"};

// The law's own formula, where the table goes on by it or there is no table.
void add_single_piece(TemplateValues& values, const Table& table,
                      const std::vector<InputArgument>& inputs, const Variables& variables) {
  const std::vector<std::string> sides = extending_sides(table, variables, table::end_rounding);
  const bool has_piece = table.is_direct() || !sides.empty();
  values.flags["has_piece"] = has_piece;
  values.text["extending"] = join(sides, " ||\n");
  values.text["piece"] = has_piece ? piece(table, inputs, device_scope) : "";
  values.text["piece_call"] = has_piece ? piece_call(table, inputs, variables) : "";
}

void add_single_formula(TemplateValues& values, const ExportRequest& request,
                        const std::vector<InputArgument>& inputs, Variables& variables) {
  const std::string formula = add_tau_R(values, request, inputs, variables);
  values.text["helpers"] = helpers(values.text["piece"] + formula, device_scope);
}

std::string single_source(const ExportRequest& request, const std::vector<InputArgument>& inputs) {
  const Table& table = request.table;
  Variables variables = variables_of(table, table.combine, inputs);
  TemplateValues values;
  values.text = {{"model", comment_text(table.model)}, {"version", tool_version()}};
  values.flags = {{"tabulated", !table.is_direct()},
                  {"has_axes", !table.is_direct() && !table.axes.empty()},
                  {"several_axes", table.axes.size() > 1},
                  {"cubic", is_cubic(table)},
                  {"log_value", table.log_value}};
  values.lists["axes"];
  add_state(values, table, inputs, variables);
  add_single_piece(values, table, inputs, variables);
  add_single_formula(values, request, inputs, variables);
  turn_single(values);
  if (!table.is_direct()) add_look_up(values, table, variables);
  return render_template("c/frictab_tau_R_f32.c", values);
}

std::vector<std::string> accuracy_lines(const RoundingBound& bound) {
  const std::string text =
      bound.MPa
          ? fmt::format(
                "Rounding: inside the ranges at most {:.2g} MPa from frictab_tau_R, that of "
                "the arguments to float included, where division and the functions of "
                "math.h err by at most 4 units in the last place.",
                table::rounded_up(*bound.MPa))
          : fmt::format("Rounding: no bound is known ({}); frictab verify says the largest found.",
                        bound.why_not);
  return wrap_text(text, 92);
}

std::string single_header(const ExportRequest& request, const std::vector<InputArgument>& inputs,
                          const RoundingBound& bound) {
  TemplateValues values;
  values.text = {{"tau_unit", solver_unit("MPa", request.units).name},
                 {"version", tool_version()},
                 {"parameters", lines(parameters(inputs, "float"))},
                 {"arrays", lines(parameters(inputs, "const float*"))}};
  values.lists["about"] = items(about_entry(request));
  values.lists["accuracy"] = items(accuracy_lines(bound));
  values.lists["inputs"] = items(argument_lines(request, inputs));
  values.lists["notes"] = items(entry_notes(request));
  return render_template("c/frictab_tau_R_f32.h", values);
}

} // namespace

void check_single(const ExportRequest& request) {
  check_single_size(request);
  for (const table::TableAxis& axis : request.table.axes)
    check_nodes(axis);
}

void add_single(SourceBundle& files, const ExportRequest& request,
                const std::vector<InputArgument>& inputs, const RoundingBound& bound) {
  files["frictab_tau_R_f32.h"] = single_header(request, inputs, bound);
  files["frictab_tau_R_f32.c"] = single_source(request, inputs);
}

nlohmann::ordered_json single_recipe(const ExportRequest& request,
                                     const std::vector<InputArgument>& inputs,
                                     const RoundingBound& bound) {
  const std::string one = join(parameters(inputs, "float"), ", ");
  const std::string many = join(parameters(inputs, "const float*"), ", ");
  const std::string gcc = "gcc " + optimisation(request.table) + " -std=c99 -ffp-contract=off";
  nlohmann::ordered_json out = {
      {"entry", "frictab_tau_R_f32"},
      {"prototypes",
       {"float frictab_tau_R_f32(" + one + ")",
        "void frictab_tau_R_f32_batch(size_t n, " + many + ", float* tau)"}},
      {"precision", "arguments, table and arithmetic are float"},
      {"unit_roundoff", 0x1p-24},
      {"rounding_bound_MPa", nullptr},
      {"drift",
       "verify.json, subject c/f32: worst_case_MPa from the law, max_vs_table_MPa from the "
       "same table in double precision; the rounding of the arguments to float is part of "
       "both"},
      {"compile",
       {gcc + " -c frictab_tau_R_f32.c",
        gcc + " -fPIC -shared -o libfrictab_tau_R_f32.so frictab_tau_R_f32.c -lm"}},
      {"device_code", "include frictab_tau_R_f32.c: in CUDA and HIP with FRICTAB_DEVICE defined as "
                      "__device__, in OpenCL C as it is"}};
  if (bound.MPa) {
    out["rounding_bound_MPa"] = *bound.MPa;
    out["rounding_bound"] =
        "inside the ranges no state is further from frictab_tau_R, the rounding "
        "of the arguments included, where division and the functions of math.h "
        "err by at most 4 units in the last place";
  } else {
    out["rounding_bound"] = "not known: " + bound.why_not;
  }
  return out;
}

} // namespace frictab::c_target
