// Power of a quantity: the usual way pressure, speed and temperature act on friction.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  // 0 to a negative power would be infinite: a thousandth of the reference is where it stops.
  return pow(maximum(x / x0, 1e-3), a);
}

EffectForm make() {
  EffectForm form;
  form.name = "power";
  form.order = 1;
  form.title = "power of x";
  form.formula = "(max(x, 0.001 x0)/x0)^a";
  form.parameters = {{"a", "1", "exponent", 0, -10, 10},
                     {"x0", "x", "reference: the factor is 1 there", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.positive(); }, false, 0}};
  form.factor = factor;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
