// A smooth curve without a named form, as the upper limit of what a column can explain.
#include <fmt/format.h>

#include "effects/effect.h"
#include "effects/natural_spline.h"

namespace frictab::effects {

using expr::Expr;

namespace {

std::vector<models::Parameter> parameters(const PlacedEffect& effect) {
  std::vector<models::Parameter> all;
  for (const double knot : effect.inputs[0].knots)
    all.push_back({fmt::format("v{}", all.size() + 1), "1",
                   fmt::format("relative change at {:.6g}", knot), 0, -10, 10});
  return all;
}

Expr factor(const PlacedEffect& effect) {
  std::vector<Expr> values;
  for (const models::Parameter& parameter : parameters(effect))
    values.push_back(Expr::symbol(parameter.name));
  return 1.0 + NaturalSpline(Expr::symbol("x"), effect.inputs[0].knots)(values);
}

std::string text(const PlacedEffect& effect) {
  const EffectInput& x = effect.inputs[0];
  return "natural cubic spline of " + x.column + " through " +
         knots_text(x.knots, effect.parameters);
}

std::vector<double> penalty(const PlacedEffect& effect) {
  return scaled_penalty(spline_roughness(effect.inputs[0].knots));
}

std::vector<double> pattern(const PlacedEffect& effect) {
  return half_wave_pattern(effect.inputs[0].knots);
}

EffectForm make() {
  EffectForm form;
  form.name = "spline";
  form.order = 30;
  form.title = "natural cubic spline";
  form.formula = "1 + spline(x)";
  form.parameters = {{"a", "1", "relative change at a knot", 0, -10, 10}};
  form.knots = {8};
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
