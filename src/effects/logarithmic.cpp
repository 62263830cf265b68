// Logarithm of a quantity, as rate effects act over decades.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  // ln 0 would be infinite: a thousandth of the reference is where it stops.
  return 1.0 + a * log(maximum(x / x0, 1e-3));
}

EffectForm make() {
  EffectForm form;
  form.name = "logarithmic";
  form.order = 4;
  form.title = "logarithm of x";
  form.formula = "1 + a ln(max(x, 0.001 x0)/x0)";
  form.parameters = {{"a", "1", "relative change per e-fold", 0, -10, 10},
                     {"x0", "x", "reference: the factor is 1 there", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.positive(); }, false, 0}};
  form.factor = factor;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
