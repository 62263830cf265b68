// An effect with one slope per level of a text column: one coating suffers from heat, another does
// not.
#include <fmt/format.h>

#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

std::vector<models::Parameter> parameters(const PlacedEffect& effect) {
  const auto& levels = effect.inputs[0].levels;
  std::vector<models::Parameter> all;
  for (std::size_t level = 0; level < levels.size(); ++level)
    all.push_back({fmt::format("a{}", level), "1",
                   fmt::format("relative change of {} over the range of x2", levels[level]), 0, -10,
                   10});
  return all;
}

// Returns the factor, which is 1 in the middle of the range of the data.
Expr factor(const PlacedEffect& effect) {
  const EffectInput& y = effect.inputs[1];
  const double range = y.high > y.low ? y.high - y.low : 1.0;
  std::vector<Expr> slopes;
  for (const models::Parameter& parameter : parameters(effect))
    slopes.push_back(Expr::symbol(parameter.name));
  return 1.0 + value_by_level(Expr::symbol("x"), slopes) *
                   ((Expr::symbol("x2") - 0.5 * (y.low + y.high)) / range);
}

std::string text(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  std::string text =
      fmt::format("change over {} from {:.4g} to {:.4g} by {}", y.column, y.low, y.high, x.column);
  for (std::size_t level = 0; level < x.levels.size(); ++level)
    text += fmt::format("{} {} {:.4g}", level == 0 ? ":" : ",", x.levels[level],
                        effect.parameters[level]);
  return text;
}

EffectForm make() {
  EffectForm form;
  form.name = "category_slope";
  form.order = 16;
  form.title = "one slope per level";
  form.formula = "1 + a_level (x2 - middle)/range";
  form.parameters = {
      {"a", "1", "relative change of the last level over the range of x2", 0, -10, 10}};
  form.columns = 2;
  form.categorical = true;
  form.parameters_of = parameters;
  form.build = factor;
  form.text = text;
  form.pattern = growing_pattern;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
