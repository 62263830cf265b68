// Thermal activation over a temperature in degrees Celsius.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  // One kelvin above absolute zero is where it stops.
  return exp(a * ((x0 + 273.15) / maximum(x + 273.15, 1.0) - 1.0));
}

EffectForm make() {
  EffectForm form;
  form.name = "arrhenius";
  form.order = 5;
  form.title = "thermal activation, x in degC";
  form.formula = "exp(a ((x0 + 273.15)/(x + 273.15) - 1))";
  form.parameters = {{"a", "1", "activation energy over R T0", 0, -100, 100},
                     {"x0", "x", "reference temperature: the factor is 1 there", 20, -272, 1e4}};
  form.shapes = {{[](const Spread& s) { return s.median; }, false, 0}};
  form.factor = factor;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
