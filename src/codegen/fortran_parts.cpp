// Names, comments, the law's own formula and the sides of the axes in fixed form.
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
#include "expr/several.h"
#include "table/outside.h"

namespace frictab::codegen::fortran {

using expr::Expr;
using table::Outside;
using table::Table;

namespace {

constexpr std::size_t comment_width = 66; // columns 7..72

} // namespace

Lines comments(const std::vector<std::string>& texts) {
  Lines lines;
  for (const std::string& text : texts) {
    const std::vector<std::string> pieces = wrap_text(comment_text(text), comment_width - 2);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      lines.push_back(item((i == 0 ? "" : "  ") + pieces[i].substr(0, comment_width - 2)));
  }
  return lines;
}

std::string clip(const std::string& text, std::size_t indent) {
  const std::size_t width = comment_width - indent;
  return wrap_text(comment_text(text), width)[0].substr(0, width);
}

std::map<std::string, std::string> symbol_names(const Table& table) {
  std::map<std::string, std::string> rename{{"value", "val"}};
  const std::vector<std::string> inputs = table.inputs();
  for (std::size_t i = 0; i < inputs.size(); ++i)
    rename[inputs[i]] = fmt::format("x({})", i + 1);
  std::size_t c = 0;
  for (const auto& [name, value] : table.constants)
    rename[name] = fmt::format("c{}", ++c);
  return rename;
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
  constexpr std::size_t per_line = 8;
  Lines lines;
  for (std::size_t i = 0; i < names.size(); i += per_line) {
    const std::size_t end = std::min(names.size(), i + per_line);
    lines.push_back(
        item(fixed_form("double precision " + join(std::span(names).subspan(i, end - i), ", "))));
  }
  return lines;
}

Lines constant_lines(const Table& table, const Expr& formula) {
  const std::set<std::string> used = expr::symbols(formula);
  const auto rename = symbol_names(table);
  Lines constants;
  for (const auto& [name, number] : table.constants) {
    if (!used.count(name)) continue;
    TemplateValues constant;
    constant.text = {{"index", rename.at(name).substr(1)},
                     {"comment", clip(name)},
                     {"value", fortran_number(number)}};
    constants.push_back(constant);
  }
  return constants;
}

std::vector<std::string> helpers_of(const std::string& statements) {
  std::vector<std::string> helpers;
  for (const char* helper : {"ftmin", "ftmax", "ftwhle"})
    if (statements.find(std::string(helper) + "(") != std::string::npos) helpers.push_back(helper);
  return helpers;
}

namespace {

// What ftpiec declares and does, gathered while its formula is written.
struct Body {
  std::map<std::string, std::string> rename;
  std::vector<std::string> names; // of double precision variables
  std::vector<std::string> held, before;
  std::string all; // every statement, to see which helpers they call

  std::string add(const expr::Statements& code, std::vector<std::string>& lines) {
    names.insert(names.end(), code.temporaries.begin(), code.temporaries.end());
    for (const std::string& line : code.lines) {
      all += line + "\n";
      lines.push_back(fixed_form(line));
    }
    return code.result;
  }
};

// h1 stands for x(1) where an axis is held at an end.
void hold(Body& body, const Table& table) {
  for (const table::AxisEnds& axis : table::axis_ends(table)) {
    if (!expr::symbols(*table.extension).count(axis.name)) continue;
    if (axis.below == Outside::law && axis.above == Outside::law) continue;
    const std::string h = fmt::format("h{}", axis.input + 1);
    body.names.push_back(h);
    body.held.push_back(fixed_form(h + " = " + body.rename.at(axis.name)));
    const auto end = [&](const char* relation, double x) {
      const std::string number = fortran_number(x);
      body.held.push_back(
          fixed_form(fmt::format("if ({0} {1} {2}) {0} = {2}", h, relation, number)));
    };
    if (axis.below != Outside::law) end(".lt.", axis.low);
    if (axis.above != Outside::law) end(".gt.", axis.high);
    body.rename[axis.name] = h;
  }
}

void add_layer(TemplateValues& values, const std::optional<UnitLayer>& layer, Body& body) {
  const UnitLayer none;
  const UnitLayer& l = layer ? *layer : none;
  Lines features;
  for (std::size_t f = 0; f < l.features.size(); ++f) {
    const expr::Statements code =
        to_statements(l.features[f], expr::Language::fortran, body.rename, fmt::format("f{}t", f));
    TemplateValues feature;
    feature.text = {{"index", std::to_string(f)}, {"name", body.add(code, body.before)}};
    features.push_back(feature);
  }
  for (std::size_t m = 0; m < l.outputs; ++m)
    body.rename[layer_output(m)] = fmt::format("net({})", m + 1);
  values.flags["has_layer"] = layer.has_value();
  values.lists["features"] = features;
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
  return without_last_break(render_template("fortran/frictab_weights.f", values));
}

// What the result changes by the weighted sum of feature f's units.
std::string feature_slope(std::size_t f) {
  return fmt::format("layer slope {}", f);
}

// By each input: what the formula behind the layer says, and through the layer's features.
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

// Value, adjoints of the layer's outputs and slopes, in this order: the layer's own sums stand
// between the last two.
void add_formulas(TemplateValues& values, const Table& table, const LayeredFormula& formula,
                  bool gradient, Body& body) {
  std::vector<Expr> formulas{formula.rest};
  const std::size_t outputs = formula.layer && gradient ? formula.layer->outputs : 0;
  for (std::size_t m = 0; m < outputs; ++m)
    formulas.push_back(derivative(formula.rest, layer_output(m)));
  for (std::size_t f = 0; outputs > 0 && f < formula.layer->features.size(); ++f)
    body.rename[feature_slope(f)] = fmt::format("b{}", f);
  if (gradient)
    for (const Expr& slope : input_slopes(table, formula))
      formulas.push_back(slope);
  const expr::SeveralStatements code =
      to_statements(formulas, expr::Language::fortran, body.rename);
  body.names.insert(body.names.end(), code.temporaries.begin(), code.temporaries.end());
  std::vector<std::string> lines;
  for (const std::string& line : code.lines) {
    body.all += line + "\n";
    lines.push_back(fixed_form(line));
  }
  const auto part = [&](std::size_t from, std::size_t to) {
    return items(std::vector<std::string>(lines.begin() + static_cast<std::ptrdiff_t>(from),
                                          lines.begin() + static_cast<std::ptrdiff_t>(to)));
  };
  const std::size_t first = code.first_lines[0], second = code.first_lines[outputs];
  values.text["result"] = code.results[0];
  values.lists["statements"] = part(0, first);
  values.lists["adjoints"] = part(first, second);
  values.lists["slopes"] = part(second, lines.size());
  values.lists["by_outputs"];
  for (std::size_t m = 0; m < outputs; ++m) {
    TemplateValues output;
    output.text = {{"index", std::to_string(m + 1)}, {"name", code.results[1 + m]}};
    values.lists["by_outputs"].push_back(output);
  }
  for (std::size_t i = 1 + outputs; i < formulas.size(); ++i)
    values.lists["slopes"].push_back(
        item(fixed_form(fmt::format("dv({}) = {}", i - outputs, code.results[i]))));
}

// Where an axis is held at an end, the formula does not change by it.
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

std::string without_last_break(std::string text) {
  if (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

Piece piece(const Table& table, bool gradient, Units units) {
  TemplateValues values;
  Body body;
  body.rename = symbol_names(table);
  hold(body, table);
  const LayeredFormula formula = split_layer(*table.extension);
  add_layer(values, formula.layer, body);
  add_formulas(values, table, formula, gradient, body);
  values.text["quantity"] = models::quantity_name(table.quantity);
  values.text["n_x"] = std::to_string(std::max<std::size_t>(table.inputs().size(), 1));
  values.flags["gradient"] = gradient;
  values.lists["declarations"] = declarations(body.names);
  values.lists["constants"] = constant_lines(table, *table.extension);
  values.lists["held"] = items(body.held);
  values.lists["before"] = items(body.before);
  values.lists["stopped"] = gradient ? stopped_sides(table) : Lines{};
  add_units(values, units);
  Piece out;
  out.data = formula.layer ? weights(*formula.layer) : "";
  values.text["data"] = units == Units::external ? out.data : "";
  out.helpers = helpers_of(body.all);
  values.lists["helpers"] = items(out.helpers);
  out.text = without_last_break(render_template("fortran/frictab_piece.f", values));
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
