// A smooth surface over two quantities, for any interaction of them.
#include <fmt/format.h>

#include "effects/effect.h"
#include "effects/natural_spline.h"

namespace frictab::effects {

using expr::Expr;

namespace {

std::string name_of(std::size_t i, std::size_t j) {
  return fmt::format("v{}_{}", i + 1, j + 1);
}

std::vector<models::Parameter> parameters(const PlacedEffect& effect) {
  const auto &x = effect.inputs[0].knots, &y = effect.inputs[1].knots;
  std::vector<models::Parameter> all;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j)
      all.push_back({name_of(i, j), "1",
                     fmt::format("relative change at ({:.6g}, {:.6g})", x[i], y[j]), 0, -10, 10});
  return all;
}

// Builds splines along x2, one per knot of x, and a spline along x through their values.
Expr factor(const PlacedEffect& effect) {
  const auto &x = effect.inputs[0].knots, &y = effect.inputs[1].knots;
  const NaturalSpline along_x2(Expr::symbol("x2"), y);
  std::vector<Expr> along;
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::vector<Expr> values;
    for (std::size_t j = 0; j < y.size(); ++j)
      values.push_back(Expr::symbol(name_of(i, j)));
    along.push_back(along_x2(values));
  }
  return 1.0 + NaturalSpline(Expr::symbol("x"), x)(along);
}

std::string text(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  std::string text = "surface of " + x.column + " and " + y.column;
  for (std::size_t i = 0; i < x.knots.size(); ++i)
    text += fmt::format(
        "{} at {:.4g} through {}", i == 0 ? ":" : ";", x.knots[i],
        knots_text(y.knots,
                   std::span(effect.parameters).subspan(i * y.knots.size(), y.knots.size())));
  return text;
}

std::vector<double> penalty(const PlacedEffect& effect) {
  return scaled_penalty(tensor_roughness(
      {spline_roughness(effect.inputs[0].knots), spline_roughness(effect.inputs[1].knots)}));
}

std::vector<double> pattern(const PlacedEffect& effect) {
  std::vector<double> values;
  for (const double a : half_wave_pattern(effect.inputs[0].knots))
    for (const double b : half_wave_pattern(effect.inputs[1].knots))
      values.push_back(a * b);
  return values;
}

EffectForm make() {
  EffectForm form;
  form.name = "surface";
  form.order = 31;
  form.title = "smooth surface over two quantities";
  form.formula = "1 + surface(x, x2)";
  form.parameters = {{"a", "1", "relative change at a pair of knots", 0, -10, 10}};
  form.columns = 2;
  form.knots = {5, 5};
  form.parameters_of = parameters;
  form.build = factor;
  form.text = text;
  form.pattern = pattern;
  form.penalty = penalty;
  return form;
}

const Registered<EffectForm> registered{make};

} // namespace
} // namespace frictab::effects
