// What a stop before the slide has changed, and sliding wears off again: a lubricant film that
// comes back, an oxide that grows, a junction that ages.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr slid = maximum(Expr::symbol("x"), 0.0) / Expr::symbol("x0");
  const Expr paused = maximum(Expr::symbol("x2"), 0.0) / Expr::symbol("t0");
  return 1.0 + Expr::symbol("a") * (exp(-slid) * exp(-paused));
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  std::vector<std::vector<double>> shapes;
  for (const double slide : {0.03, 0.1, 0.3})
    for (const double pause : {0.1, 0.3, 1.0})
      shapes.push_back({slide * (spreads[0].maximum - spreads[0].minimum),
                        pause * (spreads[1].maximum - spreads[1].minimum)});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "recovery";
  form.order = 18;
  form.title = "recovery over a pause, lost again by sliding";
  form.formula = "1 + a exp(-max(x, 0)/x0) exp(-max(x2, 0)/t0)";
  form.parameters = {
      {"a", "1", "relative change at the start of a slide without a pause before it", 0, -10, 10},
      {"x0", "x", "sliding distance over which it falls to 1/e", 1, 1e-12, 1e12},
      {"t0", "x2", "pause over which it falls to 1/e", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return 0.2 * s.span(); }, true, 0},
                 {[](const Spread& s) { return 0.3 * s.span(); }, true, 1}};
  form.columns = 2;
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
