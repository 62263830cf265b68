// Writes the law's own formula in C, with its derivatives if requested.
#include <fmt/format.h>

#include "codegen/entry_arguments.h"
#include "codegen/layer_text.h"
#include "codegen/number_text.h"
#include "codegen/sides.h"
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

const LayerSpelling layer_spelling = {"net[{}]", 0, "slope{}"};

// Adds the arrays, which the function with derivatives shares.
void add_layer_data(TemplateValues& values, const UnitLayer& layer) {
  for (std::size_t f = 0; f < layer.features.size(); ++f)
    values.lists["features"][f].text["weights"] = number_block(layer.weight[f]);
  values.text["per_output"] = std::to_string(layer.outputs ? layer.units() / layer.outputs : 0);
  values.text["bias"] = number_block(layer.bias);
  values.text["gain"] = number_block(layer.gain);
  values.text["offset"] = number_block(layer.offset);
}

// Working data for the function of the law's own formula.
struct Law {
  Variables variables;
  LayeredFormula formula;
  std::vector<std::string> states; // "double sigma_n_MPa", ...
  std::vector<Wanted> wanted;      // the layer's features, then the value
};

Law law_of(TemplateValues& values, const Table& table, const std::vector<InputArgument>& inputs) {
  const LayeredFormula formula = split_layer(*table.extension);
  Law law{variables_of(table, *table.extension, inputs, names_of_layer(formula.layer)),
          formula,
          {},
          {}};
  for (const std::string& state : piece_states(table, inputs, law.variables))
    law.states.push_back("double " + state);
  values.lists["constants"] = constants_of(table, law.variables);
  values.lists["held"] = held_axes(table, law.variables);
  law.wanted = layer_formulas(formula, law.variables.name("value"), layer_spelling, law.variables);
  return law;
}

// Adds the lines before the layer's sums, and from there to the last of the first `count` formulas
// after the features.
void add_lines(TemplateValues& values, const UnitLayer& layer, const Statements& code,
               std::size_t count) {
  const std::size_t features = layer.features.size();
  const std::size_t before = features > 0 ? code.first_lines[features - 1] : 0;
  values.lists["before"] = items(lines_between(code, 0, before));
  values.lists["statements"] =
      items(lines_between(code, before, code.first_lines[features + count - 1]));
  values.text["result"] = code.results[features];
  add_layer(values, layer, layer_spelling, code);
}

} // namespace

std::string piece(const Table& table, const std::vector<InputArgument>& inputs) {
  TemplateValues values;
  Law law = law_of(values, table, inputs);
  const Statements code = law.variables.statements(law.wanted);
  add_lines(values, law.formula.layer, code, 1);
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
  std::string tests;
  for (const Side& side : clamped_sides(table))
    if (side.axis == state)
      tests += fmt::format("{} {} {} ? 0.0 : ", x, side.sign(), c_number(side.end));
  return tests + slope;
}

// Adds value and adjoints of the layer's outputs, then, after the layer's sums, the slopes.
void add_gradient(TemplateValues& values, const Table& table,
                  const std::vector<InputArgument>& inputs, Law& law) {
  const UnitLayer& layer = law.formula.layer;
  const std::size_t last = layer.features.size() + layer.outputs; // before the slopes
  std::vector<std::string> states;
  for (const InputArgument& input : inputs)
    if (expr::symbols(*table.extension).count(input.name)) states.push_back(input.name);
  add_slopes(law.wanted, law.formula, states, layer_spelling, law.variables);
  const Statements code = law.variables.statements(law.wanted);
  values.lists["by_outputs"];
  add_lines(values, layer, code, 1 + layer.outputs);
  values.lists["slope_statements"] =
      items(lines_between(code, code.first_lines[last], code.lines.size()));
  const Variables names = variables_of(table, *table.extension, inputs);
  values.lists["slopes"];
  for (std::size_t i = 0; i < states.size(); ++i) {
    TemplateValues slope =
        item(unless_held(table, states[i], names.name(states[i]), code.results[last + 1 + i]));
    slope.text["place"] = std::to_string(i);
    values.lists["slopes"].push_back(slope);
  }
  values.flags["has_none"] = states.empty();
}

} // namespace

std::string piece_gradient(const Table& table, const std::vector<InputArgument>& inputs) {
  TemplateValues values;
  Law law = law_of(values, table, inputs);
  add_gradient(values, table, inputs, law);
  law.states.push_back("double* by");
  values.text["parameters"] = lines(law.states);
  return render_part("c/frictab_piece_gradient.c", values);
}

} // namespace frictab::c_target
