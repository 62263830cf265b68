// Straight line in a quantity.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  return 1.0 + a * ((x - x0) / w);
}

EffectForm make() {
  EffectForm form;
  form.name = "linear";
  form.order = 3;
  form.title = "linear in x";
  form.formula = "1 + a (x - x0)/w";
  form.parameters = {{"a", "1", "relative change over w", 0, -10, 10},
                     {"x0", "x", "reference: the factor is 1 there", 1, -1e12, 1e12},
                     {"w", "x", "scale, so that the amplitude has no unit", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, false, 0},
                 {[](const Spread& s) { return s.span(); }, false, 0}};
  form.factor = factor;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
