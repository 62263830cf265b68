// Smooth step between two levels: a film that breaks down, a phase that changes.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  return 1.0 + a * (0.5 * (1.0 + tanh((x - x0) / w)));
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread& s = spreads.front();
  std::vector<std::vector<double>> shapes;
  for (const double position : positions_to_try(s, 9))
    shapes.push_back({position, 0.08 * (s.maximum - s.minimum)});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "step";
  form.order = 8;
  form.title = "smooth step";
  form.formula = "1 + a (1 + tanh((x - x0)/w))/2";
  form.parameters = {{"a", "1", "relative change across the step", 0, -10, 10},
                     {"x0", "x", "place of the step", 0, -1e12, 1e12},
                     {"w", "x", "half width of the step", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, true, 0},
                 {[](const Spread& s) { return 0.125 * s.span(); }, true, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
