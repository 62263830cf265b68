// An effect with one factor per level of a text column: tool, batch, operator.
#include <fmt/format.h>

#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

// Returns a1, a2, ... of the factors 1 + a1, 1 + a2, ...; the first level is the reference.
std::vector<models::Parameter> parameters(const PlacedEffect& effect) {
  const auto& levels = effect.inputs[0].levels;
  std::vector<models::Parameter> all;
  for (std::size_t level = 1; level < levels.size(); ++level)
    all.push_back({fmt::format("a{}", level), "1",
                   fmt::format("relative change of {} against {}", levels[level], levels[0]), 0,
                   -10, 10});
  return all;
}

Expr factor(const PlacedEffect& effect) {
  std::vector<Expr> changes{0.0};
  for (const models::Parameter& parameter : parameters(effect))
    changes.push_back(Expr::symbol(parameter.name));
  return 1.0 + value_by_level(Expr::symbol("x"), changes);
}

std::string text(const PlacedEffect& effect) {
  const EffectInput& x = effect.inputs[0];
  std::string text = "factors of " + x.column + ": " + x.levels[0] + " 1";
  for (std::size_t level = 1; level < x.levels.size(); ++level)
    text += fmt::format(", {} {:.4g}", x.levels[level], 1 + effect.parameters[level - 1]);
  return text;
}

EffectForm make() {
  EffectForm form;
  form.name = "category";
  form.order = 12;
  form.title = "one factor per level";
  form.formula = "1 + a_level";
  form.parameters = {
      {"a", "1", "relative change between the first and the last level", 0, -10, 10}};
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
