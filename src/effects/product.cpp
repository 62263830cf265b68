// Two quantities that act only together.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr x2 = Expr::symbol("x2");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  const Expr y0 = Expr::symbol("y0");
  const Expr w2 = Expr::symbol("w2");
  return 1.0 + a * (((x - x0) / w) * ((x2 - y0) / w2));
}

EffectForm make() {
  EffectForm form;
  form.name = "product";
  form.order = 13;
  form.title = "product of two quantities";
  form.formula = "1 + a (x - x0)/w (x2 - y0)/w2";
  form.parameters = {{"a", "1", "relative change over w and w2", 0, -10, 10},
                     {"x0", "x", "reference: the factor is 1 there", 1, -1e12, 1e12},
                     {"w", "x", "scale, so that the amplitude has no unit", 1, 1e-12, 1e12},
                     {"y0", "x2", "reference of the second quantity", 1, -1e12, 1e12},
                     {"w2", "x2", "scale of the second quantity", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.median; }, false, 0},
                 {[](const Spread& s) { return s.span(); }, false, 0},
                 {[](const Spread& s) { return s.median; }, false, 1},
                 {[](const Spread& s) { return s.span(); }, false, 1}};
  form.columns = 2;
  form.factor = factor;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
