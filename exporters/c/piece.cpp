// Writes the law's own formula in C, with its derivatives if requested.
#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "codegen/layer.h"
#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "core/text.h"
#include "expr/derivative.h"
#include "parts.h"
#include "table/outside.h"

namespace frictab::c_target {

using expr::Expr;
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

// Lists the axes at whose ends the formula is clamped.
Lines held_axes(const Table& table, Variables& variables) {
  Lines held;
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    if (!expr::symbols(*table.extension).count(axis.name)) continue;
    const std::string x = variables.name(axis.name);
    std::string value = x;
    if (axis.above != Outside::law)
      value = fmt::format("{0} > {1} ? {1} : {2}", x, c_number(axis.high), value);
    if (axis.below != Outside::law)
      value = fmt::format("{0} < {1} ? {1} : {2}", x, c_number(axis.low), value);
    if (value == x) continue;
    TemplateValues one;
    const std::string name = variables.give(x + "_held");
    one.text = {{"name", name}, {"value", value}};
    held.push_back(one);
    variables.set(axis.name, name);
  }
  return held;
}

void add_layer(TemplateValues& values, const std::optional<UnitLayer>& layer,
               const Statements& code) {
  const UnitLayer none;
  const UnitLayer& l = layer ? *layer : none;
  Lines features;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    TemplateValues feature;
    feature.text = {{"index", std::to_string(f)}, {"name", code.results[f]}};
    features.push_back(feature);
  }
  values.flags["has_layer"] = layer.has_value();
  values.lists["features"] = features;
  values.text["units"] = std::to_string(l.units());
  values.text["outputs"] = std::to_string(l.outputs);
}

// Adds the arrays, which the function with derivatives shares.
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

// Symbol for the derivative of the result by the weighted sum of feature f's units.
std::string layer_slope(std::size_t f) {
  return fmt::format("layer slope {}", f);
}

// Returns the derivative by a state: of the formula after the layer, and through the layer's
// features.
Expr slope_by(const LayeredFormula& formula, const std::string& state) {
  Expr slope = derivative(formula.rest, state);
  for (std::size_t f = 0; formula.layer && f < formula.layer->features.size(); ++f) {
    const Expr inner = derivative(formula.layer->features[f], state);
    if (!inner.is_constant(0)) slope = slope + Expr::symbol(layer_slope(f)) * inner;
  }
  return slope;
}

// Working data for the function of the law's own formula.
struct Law {
  Variables variables;
  LayeredFormula formula;
  std::vector<std::string> states; // "double sigma_n_MPa", ...
  std::vector<Wanted> wanted;      // the layer's features, then the value
};

Law law_of(TemplateValues& values, const Table& table, const std::vector<InputArgument>& inputs) {
  LayeredFormula formula = split_layer(*table.extension);
  const UnitLayer none;
  const UnitLayer& layer = formula.layer ? *formula.layer : none;
  const auto taken =
      formula.layer ? names_of_a_layer(layer.features.size()) : std::set<std::string>{};
  Law law{variables_of(table, *table.extension, inputs, taken), formula, {}, {}};
  for (const std::string& state : piece_states(table, inputs, law.variables))
    law.states.push_back("double " + state);
  values.lists["constants"] = constants_of(table, law.variables);
  values.lists["held"] = held_axes(table, law.variables);
  for (const Expr& feature : layer.features)
    law.wanted.push_back(
        {feature, law.variables.give(fmt::format("feature{}", law.wanted.size()))});
  law.wanted.push_back({formula.rest, law.variables.name("value")});
  for (std::size_t m = 0; m < layer.outputs; ++m)
    law.variables.set(layer_output(m), fmt::format("net[{}]", m));
  return law;
}

std::vector<std::string> from_to(const Statements& code, std::size_t from, std::size_t to) {
  return {code.lines.begin() + static_cast<std::ptrdiff_t>(from),
          code.lines.begin() + static_cast<std::ptrdiff_t>(to)};
}

// Adds the lines before the layer's sums, and from there to the last of the first `count` formulas
// after the features.
void add_lines(TemplateValues& values, const LayeredFormula& formula, const Statements& code,
               std::size_t count) {
  const std::size_t features = formula.layer ? formula.layer->features.size() : 0;
  const std::size_t before = features > 0 ? code.first_lines[features - 1] : 0;
  values.lists["before"] = items(from_to(code, 0, before));
  values.lists["statements"] = items(from_to(code, before, code.first_lines[features + count - 1]));
  values.text["result"] = code.results[features];
  add_layer(values, formula.layer, code);
}

} // namespace

std::string piece(const Table& table, const std::vector<InputArgument>& inputs) {
  TemplateValues values;
  Law law = law_of(values, table, inputs);
  const Statements code = law.variables.statements(law.wanted);
  add_lines(values, law.formula, code, 1);
  add_layer_data(values, law.formula.layer);
  values.text["quantity"] = models::quantity_name(table.quantity);
  values.text["parameters"] = law.states.empty() ? "void" : lines(law.states);
  return render_part("c/frictab_piece.c", values);
}

namespace {

// Sets the slope to 0 beyond an end at which the axis is clamped, where the formula does not
// change.
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

// Adds value and adjoints of the layer's outputs, then, after the layer's sums, the slopes.
void add_slopes(TemplateValues& values, const Table& table,
                const std::vector<InputArgument>& inputs, Law& law) {
  const LayeredFormula& formula = law.formula;
  const std::size_t features = law.wanted.size() - 1;
  const std::size_t outputs = formula.layer ? formula.layer->outputs : 0;
  const std::string value = law.wanted.back().name;
  for (std::size_t m = 0; m < outputs; ++m)
    law.wanted.push_back({derivative(formula.rest, layer_output(m)),
                          law.variables.give(fmt::format("{}_by_net{}", value, m))});
  for (std::size_t f = 0; f < features; ++f)
    law.variables.set(layer_slope(f), fmt::format("slope{}", f));
  std::vector<std::string> states;
  for (const InputArgument& input : inputs)
    if (expr::symbols(*table.extension).count(input.name)) states.push_back(input.name);
  for (const std::string& state : states)
    law.wanted.push_back({slope_by(formula, state), law.variables.slope(value, state)});
  const Statements code = law.variables.statements(law.wanted);
  add_lines(values, formula, code, 1 + outputs);
  values.lists["slope_statements"] =
      items(from_to(code, code.first_lines[features + outputs], code.lines.size()));
  values.lists["by_outputs"];
  for (std::size_t m = 0; m < outputs; ++m) {
    TemplateValues output;
    output.text = {{"index", std::to_string(m)}, {"name", code.results[features + 1 + m]}};
    values.lists["by_outputs"].push_back(output);
  }
  const Variables names = variables_of(table, *table.extension, inputs);
  values.lists["slopes"];
  for (std::size_t i = 0; i < states.size(); ++i) {
    TemplateValues slope = item(unless_held(table, states[i], names.name(states[i]),
                                            code.results[features + 1 + outputs + i]));
    slope.text["place"] = std::to_string(i);
    values.lists["slopes"].push_back(slope);
  }
  values.flags["has_none"] = states.empty();
}

} // namespace

std::string piece_gradient(const Table& table, const std::vector<InputArgument>& inputs) {
  TemplateValues values;
  Law law = law_of(values, table, inputs);
  add_slopes(values, table, inputs, law);
  law.states.push_back("double* by");
  values.text["parameters"] = lines(law.states);
  return render_part("c/frictab_piece_gradient.c", values);
}

} // namespace frictab::c_target
