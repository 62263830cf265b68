// Falling boundary friction and rising viscous friction over the speed: a curve with a minimum.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr x1 = Expr::symbol("x1");
  const Expr speed = maximum(x, 0.0);
  return 1.0 + a * (exp(-(speed / x0)) + speed / x1);
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread& s = spreads.front();
  std::vector<std::vector<double>> shapes;
  for (const double fall : {0.03, 0.1, 0.3})
    for (const double rise : {0.5, 2.0})
      shapes.push_back({fall * s.maximum, rise * s.maximum});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "stribeck";
  form.order = 10;
  form.title = "Stribeck curve";
  form.formula = "1 + a (exp(-max(x, 0)/x0) + max(x, 0)/x1)";
  form.parameters = {
      {"a", "1", "relative height of the boundary branch", 0, -10, 10},
      {"x0", "x", "speed at which the boundary branch has fallen to 1/e", 1, 1e-12, 1e12},
      {"x1", "x", "speed at which the viscous branch reaches the same height", 1, 1e-12, 1e12}};
  form.shapes = {
      {[](const Spread& s) { return 0.5 * s.positive(); }, true, 0},
      {[](const Spread& s) { return s.maximum > 0 ? 2.0 * s.maximum : 2.0 * s.span(); }, true, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
