// Orders formulas around a layer's sums.
#include "codegen/layer_text.h"

#include <fmt/format.h>

#include "expr/derivative.h"

namespace frictab::codegen {

namespace {

TemplateValues numbered_name(std::size_t index, const std::string& name) {
  return {.text = {{"index", std::to_string(index)}, {"name", name}}};
}

} // namespace

std::set<std::string> names_of_layer(const UnitLayer& layer) {
  if (layer.units() == 0) return {};
  std::set<std::string> names = {"a",    "b",    "c",   "z",   "y",    "p",    "q",    "nunit",
                                 "nout", "unit", "net", "adj", "bias", "gain", "offs", "adjoint"};
  for (std::size_t f = 0; f < layer.features.size(); ++f)
    for (const char* of_each : {"wt", "b", "slope"})
      names.insert(of_each + std::to_string(f));
  return names;
}

std::vector<Wanted> layer_formulas(const LayeredFormula& formula, const std::string& value,
                                   const LayerSpelling& spelling, Variables& variables) {
  std::vector<Wanted> wanted;
  for (const expr::Expr& feature : formula.layer.features)
    wanted.push_back({feature, variables.give(fmt::format("feature{}", wanted.size()))});
  wanted.push_back({formula.rest, value});
  for (std::size_t m = 0; m < formula.layer.outputs; ++m)
    variables.set(layer_output(m), fmt::format(fmt::runtime(spelling.output), spelling.first + m));
  return wanted;
}

void add_slopes(std::vector<Wanted>& wanted, const LayeredFormula& formula,
                const std::vector<std::string>& states, const LayerSpelling& spelling,
                Variables& variables) {
  const std::string value = wanted.back().name;
  for (std::size_t m = 0; m < formula.layer.outputs; ++m)
    wanted.push_back({derivative(formula.rest, layer_output(m)),
                      variables.give(fmt::format("{}_by_net{}", value, spelling.first + m))});
  for (std::size_t f = 0; f < formula.layer.features.size(); ++f)
    variables.set(layer_slope(f), fmt::format(fmt::runtime(spelling.slope), f));
  for (const std::string& state : states)
    wanted.push_back({slope_by(formula, state), variables.slope(value, state)});
}

void add_layer(TemplateValues& values, const UnitLayer& layer, const LayerSpelling& spelling,
               const Statements& code) {
  const std::size_t features = layer.features.size();
  for (std::size_t f = 0; f < features; ++f)
    values.lists["features"].push_back(numbered_name(f, code.results[f]));
  values.lists["features"];
  values.flags["has_layer"] = layer.units() > 0;
  values.text["units"] = std::to_string(layer.units());
  values.text["outputs"] = std::to_string(layer.outputs);
  for (std::size_t m = 0; m < layer.outputs && features + 1 + m < code.results.size(); ++m)
    values.lists["by_outputs"].push_back(
        numbered_name(spelling.first + m, code.results[features + 1 + m]));
}

std::vector<std::string> lines_between(const Statements& code, std::size_t from, std::size_t to) {
  return {code.lines.begin() + static_cast<std::ptrdiff_t>(from),
          code.lines.begin() + static_cast<std::ptrdiff_t>(to)};
}

} // namespace frictab::codegen
