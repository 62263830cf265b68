// Effects of several amplitudes: a number per level of a text column, per knot of a curve, or both.
#include <algorithm>

#include <fmt/format.h>

#include "core/text.h"
#include "effects/effect.h"
#include "effects/natural_spline.h"

namespace frictab::effects {

namespace {

using expr::Expr;
using models::Parameter;

Parameter amplitude(std::string name, std::string meaning) {
  return {std::move(name), "1", std::move(meaning), 0, -10, 10};
}

std::vector<Expr> symbols_of(const std::vector<Parameter>& parameters) {
  std::vector<Expr> symbols;
  for (const Parameter& parameter : parameters)
    symbols.push_back(Expr::symbol(parameter.name));
  return symbols;
}

// Returns the formula that selects the value of level number x of a text column.
Expr value_by_level(const Expr& x, std::span<const Expr> values) {
  Expr chosen = values.back();
  for (std::size_t level = values.size() - 1; level-- > 0;)
    chosen = where_le(x, static_cast<double>(level) + 0.5, values[level], chosen);
  return chosen;
}

// Returns amplitudes of a planted effect of levels, which grow in equal steps up to 1.
std::vector<double> growing_pattern(const PlacedEffect& effect) {
  std::vector<double> values(amplitudes_of(effect));
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = static_cast<double>(i + 1) / static_cast<double>(values.size());
  return values;
}

// ---- one factor per level: tool, batch, operator ----

// Returns a1, a2, ... of the factors 1 + a1, 1 + a2, ...; the first level is the reference.
std::vector<Parameter> changes_of_levels(const PlacedEffect& effect) {
  const auto& levels = effect.inputs[0].levels;
  std::vector<Parameter> all;
  for (std::size_t level = 1; level < levels.size(); ++level)
    all.push_back(
        amplitude(fmt::format("a{}", level),
                  fmt::format("relative change of {} against {}", levels[level], levels[0])));
  return all;
}

Expr factor_of_level(const PlacedEffect& effect) {
  std::vector<Expr> changes = symbols_of(changes_of_levels(effect));
  changes.insert(changes.begin(), 0.0);
  return 1.0 + value_by_level(Expr::symbol("x"), changes);
}

std::string factors_text(const PlacedEffect& effect) {
  const EffectInput& x = effect.inputs[0];
  std::string text = "factors of " + x.column + ": " + x.levels[0] + " 1";
  for (std::size_t level = 1; level < x.levels.size(); ++level)
    text += fmt::format(", {} {:.4g}", x.levels[level], 1 + effect.parameters[level - 1]);
  return text;
}

// ---- one factor per pair of levels: a lubricant fails on one coating only ----

// Number of free changes of a text column: those of its levels add up to 0.
std::size_t free_changes(const EffectInput& text) {
  return text.levels.size() - 1;
}

std::vector<Parameter> changes_of_pairs(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  std::vector<Parameter> all;
  for (std::size_t i = 0; i < free_changes(x); ++i)
    for (std::size_t j = 0; j < free_changes(y); ++j)
      all.push_back(amplitude(fmt::format("a{}", all.size() + 1),
                              fmt::format("relative change of {} with {}, on top of what each does "
                                          "by itself",
                                          x.levels[i], y.levels[j])));
  return all;
}

Expr sum_of(std::span<const Expr> terms) {
  Expr sum = terms.front();
  for (const Expr& term : terms.subspan(1))
    sum = sum + term;
  return sum;
}

// Appends the last level's value: together the levels change nothing.
void balance(std::vector<Expr>& values) {
  values.push_back(-sum_of(values));
}

// Returns the factor; the changes add up to 0 over the levels of either text, so that neither text
// has an effect by itself.
Expr factor_of_pair(const PlacedEffect& effect) {
  const std::vector<Expr> changes = symbols_of(changes_of_pairs(effect));
  const std::size_t across = free_changes(effect.inputs[1]);
  std::vector<Expr> by_level;
  for (std::size_t i = 0; i < changes.size(); i += across) {
    std::vector<Expr> values(changes.begin() + static_cast<long>(i),
                             changes.begin() + static_cast<long>(i + across));
    balance(values);
    by_level.push_back(value_by_level(Expr::symbol("x2"), values));
  }
  balance(by_level);
  return 1.0 + value_by_level(Expr::symbol("x"), by_level);
}

std::string pairs_text(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  const std::vector<Parameter> changes = changes_of_pairs(effect);
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < changes.size(); ++k)
    parts.push_back(fmt::format("{} with {} {:.4g}", x.levels[k / free_changes(y)],
                                y.levels[k % free_changes(y)], 1 + effect.parameters[k]));
  return fmt::format("factors of {} with {}, balanced over either: {}", x.column, y.column,
                     join(parts, ", "));
}

// ---- one slope per level: one coating suffers from heat, another does not ----

std::vector<Parameter> slopes_of_levels(const PlacedEffect& effect) {
  std::vector<Parameter> all;
  for (const std::string& level : effect.inputs[0].levels)
    all.push_back(amplitude(fmt::format("a{}", all.size()),
                            fmt::format("relative change of {} over the range of x2", level)));
  return all;
}

// Returns the factor, which is 1 in the middle of the range of the data.
Expr factor_of_slope(const PlacedEffect& effect) {
  const EffectInput& y = effect.inputs[1];
  const double range = y.high > y.low ? y.high - y.low : 1.0;
  return 1.0 + value_by_level(Expr::symbol("x"), symbols_of(slopes_of_levels(effect))) *
                   ((Expr::symbol("x2") - 0.5 * (y.low + y.high)) / range);
}

std::string slopes_text(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  std::string text =
      fmt::format("change over {} from {:.4g} to {:.4g} by {}", y.column, y.low, y.high, x.column);
  for (std::size_t level = 0; level < x.levels.size(); ++level)
    text += fmt::format("{} {} {:.4g}", level == 0 ? ":" : ",", x.levels[level],
                        effect.parameters[level]);
  return text;
}

// ---- one smooth curve, as the upper limit of what a column can explain ----

std::vector<Parameter> values_at_knots(const PlacedEffect& effect) {
  std::vector<Parameter> all;
  for (const double knot : effect.inputs[0].knots)
    all.push_back(amplitude(fmt::format("v{}", all.size() + 1),
                            fmt::format("relative change at {:.6g}", knot)));
  return all;
}

Expr factor_of_curve(const PlacedEffect& effect) {
  return 1.0 + NaturalSpline(Expr::symbol("x"),
                             effect.inputs[0].knots)(symbols_of(values_at_knots(effect)));
}

std::string curve_text(const PlacedEffect& effect) {
  const EffectInput& x = effect.inputs[0];
  return "natural cubic spline of " + x.column + " through " +
         knots_text(x.knots, effect.parameters);
}

std::vector<double> curve_penalty(const PlacedEffect& effect) {
  return scaled_penalty(spline_roughness(effect.inputs[0].knots));
}

std::vector<double> half_wave(const PlacedEffect& effect) {
  return half_wave_pattern(effect.inputs[0].knots);
}

// ---- several curves over x2 ----

std::string value_name(std::size_t curve, std::size_t knot) {
  return fmt::format("v{}_{}", curve, knot + 1);
}

// Returns the values of each curve at the knots of x2: ": A through (0, 1), (2, 1.1); B through
// ...".
std::string curves_text(const PlacedEffect& effect, const std::vector<std::string>& names) {
  const std::vector<double>& knots = effect.inputs[1].knots;
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += fmt::format(
        "{} {} through {}", i == 0 ? ":" : ";", names[i],
        knots_text(knots, std::span(effect.parameters).subspan(i * knots.size(), knots.size())));
  return text;
}

// ---- one curve per level, for tools or batches that react differently to a quantity ----

std::vector<Parameter> values_of_levels(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  std::vector<Parameter> all;
  for (std::size_t level = 0; level < x.levels.size(); ++level)
    for (std::size_t k = 0; k < y.knots.size(); ++k)
      all.push_back(amplitude(value_name(level, k), fmt::format("relative change of {} at {:.6g}",
                                                                x.levels[level], y.knots[k])));
  return all;
}

// Selects the level's value at each knot, so that only one spline is evaluated.
Expr factor_of_curves(const PlacedEffect& effect) {
  std::vector<Expr> values;
  for (std::size_t k = 0; k < effect.inputs[1].knots.size(); ++k) {
    std::vector<Expr> of_level;
    for (std::size_t level = 0; level < effect.inputs[0].levels.size(); ++level)
      of_level.push_back(Expr::symbol(value_name(level, k)));
    values.push_back(value_by_level(Expr::symbol("x"), of_level));
  }
  return 1.0 + NaturalSpline(Expr::symbol("x2"), effect.inputs[1].knots)(values);
}

std::string curves_by_level_text(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  return "natural cubic splines of " + y.column + " by " + x.column + curves_text(effect, x.levels);
}

// Adds roughness along x2 only, because levels have no order.
std::vector<double> curves_penalty(const PlacedEffect& effect) {
  const std::size_t levels = effect.inputs[0].levels.size();
  return scaled_penalty(tensor_roughness(
      {std::vector<double>(levels * levels, 0.0), spline_roughness(effect.inputs[1].knots)}));
}

// Returns half waves that grow from level to level.
std::vector<double> growing_half_waves(const PlacedEffect& effect) {
  const std::size_t levels = effect.inputs[0].levels.size();
  const double last = std::max(static_cast<double>(levels - 1), 1.0);
  std::vector<double> values;
  for (std::size_t level = 0; level < levels; ++level)
    for (const double a : half_wave_pattern(effect.inputs[1].knots))
      values.push_back(static_cast<double>(level) / last * a);
  return values;
}

// ---- a smooth surface over two quantities, for any interaction of them ----

std::vector<Parameter> values_on_grid(const PlacedEffect& effect) {
  const auto &x = effect.inputs[0].knots, &y = effect.inputs[1].knots;
  std::vector<Parameter> all;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j)
      all.push_back(amplitude(value_name(i + 1, j),
                              fmt::format("relative change at ({:.6g}, {:.6g})", x[i], y[j])));
  return all;
}

// Builds splines along x2, one per knot of x, and a spline along x through their values.
Expr factor_of_surface(const PlacedEffect& effect) {
  const auto &x = effect.inputs[0].knots, &y = effect.inputs[1].knots;
  const std::vector<Expr> values = symbols_of(values_on_grid(effect));
  const NaturalSpline along_x2(Expr::symbol("x2"), y);
  std::vector<Expr> along;
  for (std::size_t i = 0; i < x.size(); ++i)
    along.push_back(along_x2(std::span(values).subspan(i * y.size(), y.size())));
  return 1.0 + NaturalSpline(Expr::symbol("x"), x)(along);
}

std::string surface_text(const PlacedEffect& effect) {
  const EffectInput &x = effect.inputs[0], &y = effect.inputs[1];
  std::vector<std::string> places;
  for (const double knot : x.knots)
    places.push_back(fmt::format("at {:.4g}", knot));
  return "surface of " + x.column + " and " + y.column + curves_text(effect, places);
}

std::vector<double> surface_penalty(const PlacedEffect& effect) {
  return scaled_penalty(tensor_roughness(
      {spline_roughness(effect.inputs[0].knots), spline_roughness(effect.inputs[1].knots)}));
}

std::vector<double> product_of_half_waves(const PlacedEffect& effect) {
  std::vector<double> values;
  for (const double a : half_wave_pattern(effect.inputs[0].knots))
    for (const double b : half_wave_pattern(effect.inputs[1].knots))
      values.push_back(a * b);
  return values;
}

// ---- the table ----

std::vector<EffectForm> amplitude_forms() {
  return {{.name = "category",
           .order = 12,
           .title = "one factor per level",
           .formula = "1 + a_level",
           .parameters = {amplitude("a", "relative change between the first and the last level")},
           .texts = 1,
           .parameters_of = changes_of_levels,
           .build = factor_of_level,
           .pattern = growing_pattern,
           .text = factors_text},
          {.name = "category_pair",
           .order = 29,
           .title = "one factor per pair of levels",
           .formula = "1 + a_level_level2",
           .parameters = {amplitude("a", "relative change of the first pair of levels")},
           .columns = 2,
           .texts = 2,
           .parameters_of = changes_of_pairs,
           .build = factor_of_pair,
           .pattern = growing_pattern,
           .text = pairs_text},
          {.name = "category_slope",
           .order = 16,
           .title = "one slope per level",
           .formula = "1 + a_level (x2 - middle)/range",
           .parameters = {amplitude("a", "relative change of the last level over the range of x2")},
           .columns = 2,
           .texts = 1,
           .parameters_of = slopes_of_levels,
           .build = factor_of_slope,
           .pattern = growing_pattern,
           .text = slopes_text},
          {.name = "spline",
           .order = 30,
           .title = "natural cubic spline",
           .formula = "1 + spline(x)",
           .parameters = {amplitude("a", "relative change at a knot")},
           .parameters_of = values_at_knots,
           .build = factor_of_curve,
           .pattern = half_wave,
           .knots = {8},
           .penalty = curve_penalty,
           .text = curve_text},
          {.name = "surface",
           .order = 31,
           .title = "smooth surface over two quantities",
           .formula = "1 + surface(x, x2)",
           .parameters = {amplitude("a", "relative change at a pair of knots")},
           .columns = 2,
           .parameters_of = values_on_grid,
           .build = factor_of_surface,
           .pattern = product_of_half_waves,
           .knots = {5, 5},
           .penalty = surface_penalty,
           .text = surface_text},
          {.name = "spline_by_level",
           .order = 32,
           .title = "natural cubic spline of a quantity, one per level",
           .formula = "1 + spline_level(x2)",
           .parameters = {amplitude("a", "relative change at a knot, of the last level")},
           .columns = 2,
           .texts = 1,
           .parameters_of = values_of_levels,
           .build = factor_of_curves,
           .pattern = growing_half_waves,
           .knots = {0, 5},
           .penalty = curves_penalty,
           .text = curves_by_level_text}};
}

const Registered<EffectForm> registered_amplitudes{amplitude_forms};

} // namespace
} // namespace frictab::effects
