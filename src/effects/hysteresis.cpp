// Another friction on the way down than on the way up: asperities that were flattened stay flat,
// lubricant that was trapped stays trapped.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

// x is the load over its peak so far: 1 while loading.
Expr factor() {
  const Expr fallen = maximum(1.0 - Expr::symbol("x"), 0.0);
  return 1.0 + Expr::symbol("a") * minimum(1.0, fallen / Expr::symbol("w"));
}

std::vector<std::vector<double>> grid(const std::vector<Spread>&) {
  return {{0.05}, {0.2}, {0.6}};
}

EffectForm make() {
  EffectForm form;
  form.name = "hysteresis";
  form.order = 15;
  form.title = "direction of load: another friction below the peak pressure so far";
  form.formula = "1 + a min((1 - x)/w, 1)";
  form.parameters = {{"a", "1", "relative change once the load has fallen by w", 0, -10, 10},
                     {"w", "x", "part of the peak load by which it has to fall", 0.2, 1e-3, 1e12}};
  form.shapes = {{[](const Spread&) { return 0.2; }, true, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
