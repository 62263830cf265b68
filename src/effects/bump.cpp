// A hump or a dip around one value: a hot spot in temperature, a resonance in speed.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  const Expr u = (x - x0) / w;
  return 1.0 + a * exp(-0.5 * (u * u));
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread& s = spreads.front();
  std::vector<std::vector<double>> shapes;
  for (const double position : positions_to_try(s, 8))
    for (const double share : {0.06, 0.15})
      shapes.push_back({position, share * (s.maximum - s.minimum)});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "bump";
  form.order = 9;
  form.title = "bump";
  form.formula = "1 + a exp(-((x - x0)/w)^2/2)";
  form.parameters = {{"a", "1", "relative height", 0, -10, 10},
                     {"x0", "x", "place of the bump", 0, -1e12, 1e12},
                     {"w", "x", "width (standard deviation)", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, true, 0},
                 {[](const Spread& s) { return s.span() / 6.0; }, true, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
