// Nothing up to a threshold, a straight line behind it.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  return 1.0 + a * (maximum(x - x0, 0.0) / w);
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread& s = spreads.front();
  std::vector<std::vector<double>> shapes;
  for (const double position : positions_to_try(s, 9))
    shapes.push_back({position, 0.5 * s.span()});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "hinge";
  form.order = 7;
  form.title = "straight line after a threshold";
  form.formula = "1 + a max(x - x0, 0)/w";
  form.parameters = {{"a", "1", "relative change over w", 0, -10, 10},
                     {"x0", "x", "threshold", 0, -1e12, 1e12},
                     {"w", "x", "scale, so that the amplitude has no unit", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, true, 0},
                 {[](const Spread& s) { return 0.5 * s.span(); }, false, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
