// A smooth curve without a named form: what a column can explain at best.
#include "effects/effect.h"

namespace frictab {
namespace {

// Natural cubic spline over five knots (Hastie, Tibshirani, Friedman 2009, eq. 5.4-5.5): straight
// beyond the outer ones. Arguments in units of the outer knots' distance.
Expr cube_above(const Expr& u, const Expr& knot) {
  const Expr d = maximum(u - knot, 0.0);
  return d * d * d;
}

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr first = Expr::symbol("x1");
  const Expr width = Expr::symbol("x5") - first;
  const auto unit = [&](const Expr& at) { return (at - first) / width; };
  const Expr u = unit(x);
  const Expr u4 = unit(Expr::symbol("x4"));
  const auto d = [&](const Expr& knot) {
    return (cube_above(u, knot) - cube_above(u, 1.0)) / (1.0 - knot);
  };
  const Expr last = d(u4);
  return 1.0 + Expr::symbol("a") * u + Expr::symbol("b2") * (d(0.0) - last) +
         Expr::symbol("b3") * (d(unit(Expr::symbol("x2"))) - last) +
         Expr::symbol("b4") * (d(unit(Expr::symbol("x3"))) - last);
}

template <int eighths> double knot(const Spread& s) {
  const double width = s.maximum > s.minimum ? s.maximum - s.minimum : s.span();
  return s.minimum + width * eighths / 8.0;
}

EffectForm make() {
  EffectForm form;
  form.name = "spline";
  form.order = 14;
  form.title = "natural cubic spline over five knots";
  form.formula = "1 + a u + b2 n2(u) + b3 n3(u) + b4 n4(u), u = (x - x1)/(x5 - x1)";
  form.amplitudes = 4;
  form.parameters = {{"a", "1", "slope over the whole range", 0, -10, 10},
                     {"b2", "1", "bend at x1", 0, -1000, 1000},
                     {"b3", "1", "bend at x2", 0, -1000, 1000},
                     {"b4", "1", "bend at x3", 0, -1000, 1000},
                     {"x1", "x", "first knot", 0, -1e12, 1e12},
                     {"x2", "x", "second knot", 0.25, -1e12, 1e12},
                     {"x3", "x", "third knot", 0.5, -1e12, 1e12},
                     {"x4", "x", "fourth knot", 0.75, -1e12, 1e12},
                     {"x5", "x", "last knot", 1, -1e12, 1e12}};
  const auto none = [](const Spread&) { return 0.0; };
  form.shapes = {{none, true, 0},     {none, true, 0},     {none, true, 0},
                 {knot<0>, false, 0}, {knot<2>, false, 0}, {knot<4>, false, 0},
                 {knot<6>, false, 0}, {knot<8>, false, 0}};
  form.factor = factor;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab
