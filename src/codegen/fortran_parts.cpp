// Writes names, comments, the law's own formula and the sides of the axes in fixed form.
#include "codegen/fortran_parts.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "codegen/fixed_form.h"
#include "codegen/layer.h"
#include "codegen/number_text.h"
#include "codegen/table_text.h"
#include "core/text.h"
#include "expr/derivative.h"
#include "table/outside.h"

namespace frictab::codegen::fortran {

using expr::Expr;
using table::Outside;
using table::Table;

namespace {

constexpr std::size_t comment_width = 66; // columns 7..72

} // namespace

Lines comments(const std::vector<std::string>& texts, std::size_t indent) {
  Lines lines;
  for (const std::string& text : texts) {
    const std::vector<std::string> pieces =
        wrap_text(comment_text(text), comment_width - 2 - indent);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      lines.push_back(item(std::string(indent, ' ') + (i == 0 ? "" : "  ") +
                           pieces[i].substr(0, comment_width - 2 - indent)));
  }
  return lines;
}

std::string locks(const std::string& stem, bool windows) {
  TemplateValues values;
  values.text["stem"] = stem;
  values.flags["windows"] = windows;
  return render_part("fortran/frictab_locks.f", values);
}

std::string in_apostrophes(std::string_view name) {
  std::string out(utf8_start(comment_text(name), 30));
  std::replace(out.begin(), out.end(), '\'', ' ');
  return out;
}

std::string clip(const std::string& text) {
  return wrap_text(comment_text(text), comment_width)[0];
}

std::string place_of(const Table& table, const std::string& state) {
  const std::vector<std::string> inputs = table.inputs();
  return fmt::format("x({})", std::find(inputs.begin(), inputs.end(), state) - inputs.begin() + 1);
}

void add_units(TemplateValues& values, Units units) {
  const bool module = units == Units::module;
  values.text["pure"] = module ? "pure " : "";
  values.text["in"] = module ? ", intent(in) ::" : "";
  values.text["out"] = module ? ", intent(out) ::" : "";
  values.flags["externals"] = !module;
  values.offered.insert({"pure", "in", "out", "externals"});
}

Lines declarations(const std::vector<std::string>& names) {
  const std::string head = "double precision ";
  Lines lines;
  std::string line;
  for (const std::string& name : names) {
    const bool fits = !line.empty() && line.size() + 2 + name.size() <= comment_width;
    if (!fits && !line.empty()) lines.push_back(item(fixed_form(line)));
    line = fits ? line + ", " + name : head + name;
  }
  if (!line.empty()) lines.push_back(item(fixed_form(line)));
  return lines;
}

Lines constant_lines(const Table& table, const Variables& variables) {
  Lines constants;
  for (const std::string& name : variables.constants()) {
    const std::string& own = variables.name(name);
    TemplateValues constant;
    constant.text = {
        {"name", own},
        {"comment", clip(name)},
        {"statement", fixed_form(fmt::format("parameter ({} = {})", own,
                                             fortran_number(table.constants.at(name))))}};
    constant.flags["renamed"] = own != name;
    constants.push_back(constant);
  }
  return constants;
}

std::vector<std::string> states_from_x(const Table& table, const Variables& variables,
                                       const Expr& formula, std::vector<std::string>& names) {
  std::vector<std::string> lines;
  for (const std::string& state : variables.states_of(formula)) {
    names.push_back(variables.name(state));
    lines.push_back(names.back() + " = " + place_of(table, state));
  }
  return lines;
}

std::vector<std::string> moved(const std::string& result, const std::string& variable) {
  if (result == variable) return {};
  return {variable + " = " + result};
}

Lines fixed_lines(const std::vector<std::string>& statements) {
  Lines lines;
  for (const std::string& statement : statements)
    lines.push_back(item(fixed_form(statement)));
  return lines;
}

std::vector<std::string> helpers_of(const std::string& statements) {
  std::vector<std::string> helpers;
  for (const char* helper : {"ftmin", "ftmax", "ftwhle"})
    if (statements.find(std::string(helper) + "(") != std::string::npos) helpers.push_back(helper);
  return helpers;
}

namespace {

// Clamps the state of an axis that is clamped at an end.
std::vector<std::string> held_lines(const Table& table, const Variables& variables) {
  std::vector<std::string> lines;
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    if (!expr::symbols(*table.extension).count(axis.name)) continue;
    const std::string& x = variables.name(axis.name);
    const auto end = [&](const char* relation, double at) {
      lines.push_back(fmt::format("if ({0} {1} {2}) {0} = {2}", x, relation, fortran_number(at)));
    };
    if (axis.below != Outside::law) end(".lt.", axis.low);
    if (axis.above != Outside::law) end(".gt.", axis.high);
  }
  return lines;
}

void add_layer(TemplateValues& values, const std::optional<UnitLayer>& layer,
               const Statements& code) {
  const UnitLayer none;
  const UnitLayer& l = layer ? *layer : none;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    TemplateValues feature;
    feature.text = {{"index", std::to_string(f)}, {"name", code.results[f]}};
    values.lists["features"].push_back(feature);
  }
  values.lists["features"];
  values.flags["has_layer"] = layer.has_value();
  values.text["units"] = std::to_string(l.units());
  values.text["outputs"] = std::to_string(l.outputs);
}

std::string weights(const UnitLayer& l) {
  TemplateValues values;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    TemplateValues feature;
    feature.text = {{"index", std::to_string(f)},
                    {"data", fixed_form_data(fmt::format("wt{}", f), l.weight[f])}};
    values.lists["features"].push_back(feature);
  }
  values.text["units"] = std::to_string(l.units());
  values.text["outputs"] = std::to_string(l.outputs);
  values.text["data_bias"] = fixed_form_data("bias", l.bias);
  values.text["data_gain"] = fixed_form_data("gain", l.gain);
  values.text["data_offs"] = fixed_form_data("offs", l.offset);
  return render_part("fortran/frictab_weights.f", values);
}

// Symbol for the derivative of the result by the weighted sum of feature f's units.
std::string feature_slope(std::size_t f) {
  return fmt::format("layer slope {}", f);
}

// Returns the derivatives by each input: of the formula after the layer, and through the layer's
// features.
std::vector<Expr> input_slopes(const Table& table, const LayeredFormula& formula) {
  std::vector<Expr> slopes;
  for (const std::string& name : table.inputs()) {
    Expr slope = derivative(formula.rest, name);
    for (std::size_t f = 0; formula.layer && f < formula.layer->features.size(); ++f) {
      const Expr inner = derivative(formula.layer->features[f], name);
      if (!inner.is_constant(0)) slope = slope + Expr::symbol(feature_slope(f)) * inner;
    }
    slopes.push_back(slope);
  }
  return slopes;
}

// Returns, in this order, features of the layer, value, adjoints of the layer's outputs and slopes.
// The layer's own sums come after the features and before the slopes.
std::vector<Wanted> formulas_of(const Table& table, const LayeredFormula& formula, bool gradient,
                                const std::string& value, Variables& variables) {
  const UnitLayer none;
  const UnitLayer& layer = formula.layer ? *formula.layer : none;
  std::vector<Wanted> wanted;
  for (const Expr& feature : layer.features)
    wanted.push_back({feature, variables.give(fmt::format("feature{}", wanted.size()))});
  wanted.push_back({formula.rest, value});
  for (std::size_t m = 0; m < layer.outputs; ++m)
    variables.set(layer_output(m), fmt::format("net({})", m + 1));
  if (!gradient) return wanted;
  for (std::size_t m = 0; m < layer.outputs; ++m)
    wanted.push_back({derivative(formula.rest, layer_output(m)),
                      variables.give(fmt::format("{}_by_net{}", value, m + 1))});
  for (std::size_t f = 0; f < layer.features.size(); ++f)
    variables.set(feature_slope(f), fmt::format("b{}", f));
  const std::vector<std::string> inputs = table.inputs();
  const std::vector<Expr> slopes = input_slopes(table, formula);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    wanted.push_back({slopes[i], variables.slope(value, inputs[i])});
  return wanted;
}

// Adds the formulas of ftpiec or ftpieg, whose result is `value`. Returns the statements.
Statements add_formulas(TemplateValues& values, const Table& table, const LayeredFormula& formula,
                        bool gradient, const std::string& value, Variables& variables) {
  const Statements code =
      variables.statements(formulas_of(table, formula, gradient, value, variables));
  const std::size_t features = formula.layer ? formula.layer->features.size() : 0;
  const std::size_t outputs = formula.layer && gradient ? formula.layer->outputs : 0;
  const auto part = [&](std::size_t from, std::size_t to) {
    return std::vector<std::string>(code.lines.begin() + static_cast<std::ptrdiff_t>(from),
                                    code.lines.begin() + static_cast<std::ptrdiff_t>(to));
  };
  const std::size_t before = features > 0 ? code.first_lines[features - 1] : 0;
  const std::size_t first = code.first_lines[features];
  const std::size_t second = code.first_lines[features + outputs];
  std::vector<std::string> statements = part(before, first),
                           slopes = part(second, code.lines.size());
  for (const std::string& line : moved(code.results[features], value))
    statements.push_back(line);
  for (std::size_t i = features + 1 + outputs; i < code.results.size(); ++i)
    slopes.push_back(fmt::format("dv({}) = {}", i - features - outputs, code.results[i]));
  values.lists["before"] = fixed_lines(part(0, before));
  values.lists["statements"] = fixed_lines(statements);
  values.lists["adjoints"] = fixed_lines(part(first, second));
  values.lists["slopes"] = fixed_lines(slopes);
  values.lists["by_outputs"];
  for (std::size_t m = 0; m < outputs; ++m) {
    TemplateValues output;
    output.text = {{"index", std::to_string(m + 1)}, {"name", code.results[features + 1 + m]}};
    values.lists["by_outputs"].push_back(output);
  }
  add_layer(values, formula.layer, code);
  return code;
}

// Lists the sides at which an axis is clamped: the formula does not change by it beyond them.
Lines stopped_sides(const Table& table) {
  Lines lines;
  for (const Outside kind : {Outside::clamp, Outside::error})
    for (const table::AxisEnds& axis : table::axis_ends(table)) {
      if (!expr::symbols(*table.extension).count(axis.name)) continue;
      const auto add = [&](const char* relation, double limit) {
        TemplateValues side;
        side.text = {{"index", std::to_string(axis.input + 1)},
                     {"relation", relation},
                     {"limit", fortran_number(limit)}};
        lines.push_back(side);
      };
      if (axis.below == kind) add(".lt.", axis.low);
      if (axis.above == kind) add(".gt.", axis.high);
    }
  return lines;
}

} // namespace

Piece piece(const Table& table, bool gradient, Units units) {
  TemplateValues values;
  const LayeredFormula formula = split_layer(*table.extension);
  Variables variables(table, *table.extension, Language::fortran, {},
                      formula.layer ? names_of_a_layer(formula.layer->features.size())
                                    : std::set<std::string>{});
  const std::string value = gradient ? variables.name("value") : "ftpiec";
  std::vector<std::string> names;
  std::vector<std::string> states = states_from_x(table, variables, *table.extension, names);
  for (const std::string& line : held_lines(table, variables))
    states.push_back(line);
  const Statements code = add_formulas(values, table, formula, gradient, value, variables);
  names.insert(names.end(), code.names.begin(), code.names.end());
  std::erase(names, value);
  values.text["value"] = value;
  values.text["quantity"] = models::quantity_name(table.quantity);
  values.text["n_x"] = std::to_string(std::max<std::size_t>(table.inputs().size(), 1));
  values.flags["gradient"] = gradient;
  values.lists["declarations"] = declarations(names);
  values.lists["constants"] = constant_lines(table, variables);
  values.lists["states"] = fixed_lines(states);
  values.lists["stopped"] = gradient ? stopped_sides(table) : Lines{};
  add_units(values, units);
  Piece out;
  out.data = formula.layer ? weights(*formula.layer) : "";
  values.text["data"] = units == Units::external ? out.data : "";
  out.helpers = helpers_of(join(code.lines, "\n"));
  values.lists["helpers"] = items(out.helpers);
  out.text = render_part("fortran/frictab_piece.f", values);
  return out;
}

Lines sides(const Table& table, Outside kind) {
  Lines lines;
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    const bool refuses = kind == Outside::error;
    const auto add = [&](const char* relation, double limit) {
      TemplateValues side;
      side.text = {{"index", std::to_string(axis.input + 1)},
                   {"relation", relation},
                   {"limit", fortran_number(limit)}};
      lines.push_back(side);
    };
    if (axis.below == kind) add(".lt.", refuses ? axis.refused_below : axis.low);
    if (axis.above == kind) add(".gt.", refuses ? axis.refused_above : axis.high);
  }
  return lines;
}

} // namespace frictab::codegen::fortran
