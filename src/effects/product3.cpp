// Three quantities that act only together.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

Expr factor() {
  const auto part = [](const char* x, const char* reference, const char* scale) {
    return (Expr::symbol(x) - Expr::symbol(reference)) / Expr::symbol(scale);
  };
  return 1.0 + Expr::symbol("a") *
                   (part("x", "x0", "w") * part("x2", "y0", "w2") * part("x3", "z0", "w3"));
}

EffectForm make() {
  EffectForm form;
  form.name = "product3";
  form.order = 19;
  form.title = "product of three quantities";
  form.formula = "1 + a (x - x0)/w (x2 - y0)/w2 (x3 - z0)/w3";
  form.parameters = {{"a", "1", "relative change over w, w2 and w3", 0, -10, 10},
                     {"x0", "x", "reference: the factor is 1 there", 1, -1e12, 1e12},
                     {"w", "x", "scale, so that the amplitude has no unit", 1, 1e-12, 1e12},
                     {"y0", "x2", "reference of the second quantity", 1, -1e12, 1e12},
                     {"w2", "x2", "scale of the second quantity", 1, 1e-12, 1e12},
                     {"z0", "x3", "reference of the third quantity", 1, -1e12, 1e12},
                     {"w3", "x3", "scale of the third quantity", 1, 1e-12, 1e12}};
  for (std::size_t input = 0; input < 3; ++input) {
    form.shapes.push_back({[](const Spread& s) { return s.median; }, false, input});
    form.shapes.push_back({[](const Spread& s) { return s.span(); }, false, input});
  }
  form.columns = 3;
  form.factor = factor;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
