// A threshold that a second quantity moves: the colder the tool, the longer the slide before it
// galls.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr first = (Expr::symbol("x") - Expr::symbol("x0")) / Expr::symbol("w");
  const Expr second = (Expr::symbol("x2") - Expr::symbol("y0")) / Expr::symbol("w2");
  return 1.0 + Expr::symbol("a") * maximum(first + Expr::symbol("b") * second, 0.0);
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread &x = spreads[0], &y = spreads[1];
  std::vector<std::vector<double>> shapes;
  for (const double position : positions_to_try(x, 5))
    for (const double b : {-1.0, -0.4, 0.4, 1.0})
      shapes.push_back({position, 0.5 * x.span(), b, y.median, y.span()});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "threshold2";
  form.order = 17;
  form.title = "threshold in two quantities";
  form.formula = "1 + a max((x - x0)/w + b (x2 - y0)/w2, 0)";
  form.parameters = {{"a", "1", "relative change over w", 0, -10, 10},
                     {"x0", "x", "threshold of x where x2 is y0", 0, -1e12, 1e12},
                     {"w", "x", "scale, so that the amplitude has no unit", 1, 1e-12, 1e12},
                     {"b", "1", "what w2 of x2 counts in w of x", 0.5, -10, 10},
                     {"y0", "x2", "reference of the second quantity", 0, -1e12, 1e12},
                     {"w2", "x2", "scale of the second quantity", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, true, 0},
                 {[](const Spread& s) { return 0.5 * s.span(); }, false, 0},
                 {[](const Spread&) { return 0.5; }, true, 1},
                 {[](const Spread& s) { return s.median; }, false, 1},
                 {[](const Spread& s) { return s.span(); }, false, 1}};
  form.columns = 2;
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
