// A wave along a quantity: eccentric tools, stick-slip, machining marks.
#include "effects/effect.h"

namespace frictab::effects {

using expr::Expr;

namespace {

constexpr double two_pi = 6.283185307179586;

Expr factor() {
  const Expr x = Expr::symbol("x");
  const Expr a = Expr::symbol("a");
  const Expr x0 = Expr::symbol("x0");
  const Expr w = Expr::symbol("w");
  return 1.0 + a * sin(two_pi * ((x - x0) / w));
}

// Wavelengths from twice the range to a fifteenth of it, with two phases each.
std::vector<std::vector<double>> grid(const std::vector<Spread>& spreads) {
  const Spread& s = spreads.front();
  std::vector<std::vector<double>> shapes;
  for (int i = 0; i < 24; ++i) {
    const double wave = (s.maximum - s.minimum) / (0.5 + 0.6 * i);
    shapes.push_back({s.minimum, wave});
    shapes.push_back({s.minimum + 0.25 * wave, wave});
  }
  return shapes;
}

EffectForm make() {
  EffectForm form;
  form.name = "periodic";
  form.order = 11;
  form.title = "wave";
  form.formula = "1 + a sin(2 pi (x - x0)/w)";
  form.parameters = {{"a", "1", "relative amplitude", 0, -10, 10},
                     {"x0", "x", "a place where the wave rises through zero", 0, -1e12, 1e12},
                     {"w", "x", "wavelength", 1, 1e-12, 1e12}};
  form.shapes = {{[](const Spread& s) { return s.low; }, true, 0},
                 {[](const Spread& s) { return 0.3 * s.span(); }, true, 0}};
  form.factor = factor;
  form.grid = grid;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
