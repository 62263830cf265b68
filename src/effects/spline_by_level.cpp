// An effect with one smooth curve per level of a text column, for tools or batches that react
// differently to a quantity.
#include <fmt/format.h>

#include "effects/effect.h"
#include "effects/natural_spline.h"

namespace frictab::effects {

using expr::Expr;

namespace {

std::string name_of(std::size_t level, std::size_t knot) {
  return fmt::format("v{}_{}", level, knot + 1);
}

std::vector<models::Parameter> parameters(const PlacedEffect& effect) {
  const EffectInput &text = effect.inputs[0], &y = effect.inputs[1];
  std::vector<models::Parameter> all;
  for (std::size_t level = 0; level < text.levels.size(); ++level)
    for (std::size_t k = 0; k < y.knots.size(); ++k)
      all.push_back({name_of(level, k), "1",
                     fmt::format("relative change of {} at {:.6g}", text.levels[level], y.knots[k]),
                     0, -10, 10});
  return all;
}

// Selects the level's value at each knot, so that only one spline is evaluated.
Expr factor(const PlacedEffect& effect) {
  const std::size_t levels = effect.inputs[0].levels.size();
  std::vector<Expr> values;
  for (std::size_t k = 0; k < effect.inputs[1].knots.size(); ++k) {
    std::vector<Expr> of_level;
    for (std::size_t level = 0; level < levels; ++level)
      of_level.push_back(Expr::symbol(name_of(level, k)));
    values.push_back(value_by_level(Expr::symbol("x"), of_level));
  }
  return 1.0 + NaturalSpline(Expr::symbol("x2"), effect.inputs[1].knots)(values);
}

std::string text(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  std::string text = "natural cubic splines of " + y.column + " by " + x.column;
  for (std::size_t level = 0; level < x.levels.size(); ++level)
    text += fmt::format(
        "{} {} through {}", level == 0 ? ":" : ";", x.levels[level],
        knots_text(y.knots,
                   std::span(effect.parameters).subspan(level * y.knots.size(), y.knots.size())));
  return text;
}

// Adds roughness along x2 only, because levels have no order.
std::vector<double> penalty(const PlacedEffect& effect) {
  const std::size_t levels = effect.inputs[0].levels.size();
  return scaled_penalty(tensor_roughness(
      {std::vector<double>(levels * levels, 0.0), spline_roughness(effect.inputs[1].knots)}));
}

// Returns a pattern that grows from level to level.
std::vector<double> pattern(const PlacedEffect& effect) {
  const double last = static_cast<double>(effect.inputs[0].levels.size() - 1);
  std::vector<double> values;
  for (std::size_t level = 0; level < effect.inputs[0].levels.size(); ++level)
    for (const double a : half_wave_pattern(effect.inputs[1].knots))
      values.push_back(static_cast<double>(level) / std::max(last, 1.0) * a);
  return values;
}

EffectForm make() {
  EffectForm form;
  form.name = "spline_by_level";
  form.order = 32;
  form.title = "natural cubic spline of a quantity, one per level";
  form.formula = "1 + spline_level(x2)";
  form.parameters = {{"a", "1", "relative change at a knot, of the last level", 0, -10, 10}};
  form.columns = 2;
  form.categorical = true;
  form.knots = {0, 5};
  form.parameters_of = parameters;
  form.build = factor;
  form.text = text;
  form.pattern = pattern;
  form.penalty = penalty;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
