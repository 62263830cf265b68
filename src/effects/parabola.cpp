// A U: least, or most, friction at an optimum.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr u = (Expr::symbol("x") - Expr::symbol("x0")) / Expr::symbol("w");
  return 1.0 + Expr::symbol("a") * (u * u);
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  std::vector<std::vector<double>> shapes;
  for (const double position : positions_to_try(spreads.front(), 5))
    shapes.push_back({position, spreads.front().span()});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "parabola";
  form.order = 14;
  form.title = "U-shape about an optimum";
  form.formula = "1 + a ((x - x0)/w)^2";
  form.parameters = {{"a", "1", "relative change at a distance of w", 0, -10, 10},
                     {"x0", "x", "optimum", 0, -1e12, 1e12},
                     {"w", "x", "scale, so that the amplitude has no unit", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, true, 0},
                 {[](const Spread& s) { return s.span(); }, false, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
