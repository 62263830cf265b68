// Growth that comes to an end: running-in, depletion of a film.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  return 1.0 + a * (1.0 - exp(-(maximum(x, 0.0) / x0)));
}

std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread& s = spreads.front();
  std::vector<std::vector<double>> shapes;
  for (const double share : {0.02, 0.05, 0.12, 0.3, 0.8})
    shapes.push_back({share * (s.maximum - s.minimum)});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "saturation";
  form.order = 6;
  form.title = "saturating growth";
  form.formula = "1 + a (1 - exp(-max(x, 0)/x0))";
  form.parameters = {{"a", "1", "relative change reached in the end", 0, -10, 10},
                     {"x0", "x", "distance over which 63 % is reached", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return 0.25 * s.span(); }, true, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
