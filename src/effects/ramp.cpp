// A straight line from one threshold to another, nothing before and no more behind.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  return 1.0 + a * minimum(maximum((x - x0) / w, 0.0), 1.0);
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread& s = spreads.front();
  std::vector<std::vector<double>> shapes;
  for (const double position : positions_to_try(s, 7))
    for (const double width : {0.25, 0.5})
      shapes.push_back({position, width * s.span()});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "ramp";
  form.order = 24;
  form.title = "straight line between two thresholds";
  form.formula = "1 + a min(max((x - x0)/w, 0), 1)";
  form.parameters = {{"a", "1", "relative change across the ramp", 0, -10, 10},
                     {"x0", "x", "where the ramp begins", 0, -1e12, 1e12},
                     {"w", "x", "its width", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, true, 0},
                 {[](const Spread& s) { return 0.25 * s.span(); }, true, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
