// An angle: friction along and across the lay of a surface or the rolling direction.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

constexpr double two_pi = 6.283185307179586;
constexpr double half_turn = 180; // what a lay that has no arrow repeats after

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  return 1.0 + a * sin(two_pi * ((x - x0) / w + 0.25));
}

// Half turns and whole ones, in sixteenths of half of them: the other half is minus the first.
std::vector<std::vector<double>> grid(const std::vector<Spread>&) {
  std::vector<std::vector<double>> shapes;
  for (const double turn : {half_turn, 2 * half_turn})
    for (int i = 0; i < 8; ++i)
      shapes.push_back({turn * i / 16, turn});
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "cosine";
  form.order = 23;
  form.title = "cosine of an angle";
  form.formula = "1 + a cos(2 pi (x - x0)/w)";
  form.parameters = {{"a", "1", "relative amplitude", 0, -10, 10},
                     {"x0", "x", "angle of the largest (a < 0: smallest) friction", 0, -1e12, 1e12},
                     {"w", "x", "turn after which it repeats", half_turn, 1e-12, 1e12}};
  form.shapes = {{[](const Spread&) { return 0.0; }, true, 0},
                 {[](const Spread&) { return half_turn; }, false, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
