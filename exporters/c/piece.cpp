// The law's own formula in C, with its derivatives where asked for.
#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "codegen/layer.h"
#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "core/text.h"
#include "expr/derivative.h"
#include "expr/several.h"
#include "parts.h"
#include "table/outside.h"

namespace frictab::c_target {

using expr::Expr;
using expr::Language;
using namespace codegen;
using table::Outside;
using table::Table;

namespace {

std::string numbers(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values)
    texts.push_back(c_number(value));
  return number_lines(texts, 98, "    ");
}

// Axes where the formula is held at an end: h1 stands for x1 there.
Lines held_axes(const Table& table, std::map<std::string, std::string>& rename) {
  Lines held;
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    if (!expr::symbols(*table.extension).count(axis.name)) continue;
    const std::string x = rename.at(axis.name), h = "h" + x.substr(1);
    std::string value = x;
    if (axis.above != Outside::law)
      value = fmt::format("{0} > {1} ? {1} : {2}", x, c_number(axis.high), value);
    if (axis.below != Outside::law)
      value = fmt::format("{0} < {1} ? {1} : {2}", x, c_number(axis.low), value);
    if (value == x) continue;
    TemplateValues one;
    one.text = {{"name", h}, {"value", value}};
    held.push_back(one);
    rename[axis.name] = h;
  }
  return held;
}

void add_layer(TemplateValues& values, const std::optional<UnitLayer>& layer,
               std::map<std::string, std::string>& rename) {
  const UnitLayer none;
  const UnitLayer& l = layer ? *layer : none;
  Lines before, features;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    const expr::Statements code =
        to_statements(l.features[f], Language::c, rename, fmt::format("f{}_", f));
    for (const std::string& line : code.lines)
      before.push_back(item(line));
    TemplateValues feature;
    feature.text = {{"index", std::to_string(f)}, {"name", code.result}};
    features.push_back(feature);
  }
  for (std::size_t m = 0; m < l.outputs; ++m)
    rename[layer_output(m)] = fmt::format("net[{}]", m);
  values.flags["has_layer"] = layer.has_value();
  values.lists["before"] = before;
  values.lists["features"] = features;
  values.text["units"] = std::to_string(l.units());
  values.text["outputs"] = std::to_string(l.outputs);
}

// The arrays, which the function with derivatives shares.
void add_layer_data(TemplateValues& values, const std::optional<UnitLayer>& layer) {
  const UnitLayer none;
  const UnitLayer& l = layer ? *layer : none;
  for (std::size_t f = 0; f < l.features.size(); ++f)
    values.lists["features"][f].text["weights"] = numbers(l.weight[f]);
  values.text["per_output"] = std::to_string(l.outputs ? l.units() / l.outputs : 0);
  values.text["bias"] = numbers(l.bias);
  values.text["gain"] = numbers(l.gain);
  values.text["offset"] = numbers(l.offset);
}

// What the result changes by the weighted sum of feature f's units.
std::string layer_slope(std::size_t f) {
  return fmt::format("layer slope {}", f);
}

// By each state: what the formula behind the layer says, and through the layer's features.
Expr slope_by(const LayeredFormula& formula, const std::string& state) {
  Expr slope = derivative(formula.rest, state);
  for (std::size_t f = 0; formula.layer && f < formula.layer->features.size(); ++f) {
    const Expr inner = derivative(formula.layer->features[f], state);
    if (!inner.is_constant(0)) slope = slope + Expr::symbol(layer_slope(f)) * inner;
  }
  return slope;
}

// What piece and derivatives have in common; `rename` takes the names of what they compute.
LayeredFormula add_piece(TemplateValues& values, const Table& table,
                         std::map<std::string, std::string>& rename) {
  values.lists["held"] = held_axes(table, rename);
  values.lists["constants"] = constants_of(table, *table.extension);
  const LayeredFormula formula = split_layer(*table.extension);
  add_layer(values, formula.layer, rename);
  return formula;
}

std::vector<std::string> state_parameters(const Table& table,
                                          const std::vector<InputArgument>& inputs) {
  std::vector<std::string> states;
  for (const std::string& state : piece_states(table, inputs))
    states.push_back("double " + state);
  return states;
}

} // namespace

std::string piece(const Table& table, const std::vector<InputArgument>& inputs) {
  const std::vector<std::string> states = state_parameters(table, inputs);
  auto rename = symbol_names(table, inputs);
  TemplateValues values;
  const LayeredFormula formula = add_piece(values, table, rename);
  add_layer_data(values, formula.layer);
  const expr::Statements code = to_statements(formula.rest, Language::c, rename);
  values.lists["statements"] = items(code.lines);
  values.text["result"] = code.result;
  values.text["quantity"] = models::quantity_name(table.quantity);
  values.text["parameters"] = states.empty() ? "void" : lines(states);
  return without_last_break(render_template("c/frictab_piece.c", values));
}

namespace {

// An axis that is held at an end does not change the formula there.
std::string unless_held(const Table& table, const std::string& state, const std::string& x,
                        const std::string& slope) {
  std::string text = slope;
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    if (axis.name != state) continue;
    if (axis.above != Outside::law)
      text = fmt::format("{} > {} ? 0.0 : {}", x, c_number(axis.high), text);
    if (axis.below != Outside::law)
      text = fmt::format("{} < {} ? 0.0 : {}", x, c_number(axis.low), text);
  }
  return text;
}

std::vector<std::string> from_to(const expr::SeveralStatements& code, std::size_t from,
                                 std::size_t to) {
  return {code.lines.begin() + static_cast<std::ptrdiff_t>(from),
          code.lines.begin() + static_cast<std::ptrdiff_t>(to)};
}

// Value and adjoints of the layer's outputs, then, behind the layer's sums, the slopes.
void add_slopes(TemplateValues& values, const Table& table,
                const std::vector<InputArgument>& inputs, const LayeredFormula& formula,
                std::map<std::string, std::string> rename) {
  const std::size_t outputs = formula.layer ? formula.layer->outputs : 0;
  std::vector<Expr> formulas{formula.rest};
  for (std::size_t m = 0; m < outputs; ++m)
    formulas.push_back(derivative(formula.rest, layer_output(m)));
  for (std::size_t f = 0; formula.layer && f < formula.layer->features.size(); ++f)
    rename[layer_slope(f)] = fmt::format("slope{}", f);
  std::vector<std::string> states;
  for (const InputArgument& input : inputs)
    if (expr::symbols(*table.extension).count(input.name)) states.push_back(input.name);
  for (const std::string& state : states)
    formulas.push_back(slope_by(formula, state));
  const expr::SeveralStatements code = to_statements(formulas, Language::c, rename);
  const std::size_t first = code.first_lines[outputs];
  values.lists["statements"] = items(from_to(code, 0, first));
  values.lists["slope_statements"] = items(from_to(code, first, code.lines.size()));
  values.text["result"] = code.results[0];
  values.lists["by_outputs"];
  for (std::size_t m = 0; m < outputs; ++m) {
    TemplateValues output;
    output.text = {{"index", std::to_string(m)}, {"name", code.results[1 + m]}};
    values.lists["by_outputs"].push_back(output);
  }
  const auto names = symbol_names(table, inputs);
  values.lists["slopes"];
  for (std::size_t i = 0; i < states.size(); ++i) {
    TemplateValues slope =
        item(unless_held(table, states[i], names.at(states[i]), code.results[1 + outputs + i]));
    slope.text["place"] = std::to_string(i);
    values.lists["slopes"].push_back(slope);
  }
  values.flags["has_none"] = states.empty();
}

} // namespace

std::string piece_gradient(const Table& table, const std::vector<InputArgument>& inputs) {
  std::vector<std::string> states = state_parameters(table, inputs);
  auto rename = symbol_names(table, inputs);
  TemplateValues values;
  const LayeredFormula formula = add_piece(values, table, rename);
  add_slopes(values, table, inputs, formula, rename);
  values.text["parameters"] = states.empty() ? "" : lines(states) + ", ";
  return without_last_break(render_template("c/frictab_piece_gradient.c", values));
}

} // namespace frictab::c_target
