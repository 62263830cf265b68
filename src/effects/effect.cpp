// Looks up effect forms and starts their shape parameters from the data.
#include "effects/effect.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/names.h"
#include "core/order_statistics.h"
#include "data/derived.h"
#include "data/quantity.h"
#include "effects/natural_spline.h"

namespace frictab::effects {

using expr::Expr;

namespace {

constexpr std::array<const char*, 4> acts_on_names = {"mu", "m", "tau", "mu+m"}; // by ActsOn

// Returns position i of `count`, spaced evenly over the central 90 % of a column's range, as a
// place for thresholds, humps and steps.
double position_to_try(const Spread& spread, std::size_t i, std::size_t count) {
  return spread.minimum +
         (spread.maximum - spread.minimum) *
             (0.05 + 0.9 * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
}

std::vector<double> values_to_try(const Shape& shape, const Spread& spread) {
  std::vector<double> values;
  for (std::size_t i = 0; i < shape.positions; ++i)
    values.push_back(position_to_try(spread, i, shape.positions));
  for (const double share : shape.tried_shares)
    values.push_back(share * shape.tried_measure(spread));
  if (values.empty()) values.push_back(shape.start(spread));
  return values;
}

} // namespace

const char* acts_on_name(ActsOn acts_on) {
  return acts_on_names[static_cast<std::size_t>(acts_on)];
}

std::optional<ActsOn> find_acts_on(std::string_view name) {
  const auto at = std::ranges::find(acts_on_names, name);
  if (at == acts_on_names.end()) return std::nullopt;
  return static_cast<ActsOn>(at - acts_on_names.begin());
}

double Spread::span() const {
  if (high > low) return high - low;
  if (maximum > minimum) return maximum - minimum;
  return std::abs(median) > 0 ? std::abs(median) : 1.0;
}

double Spread::positive() const {
  return median > 0 ? median : span();
}

Spread spread_of(std::span<const double> values) {
  std::vector<double> finite;
  finite.reserve(values.size());
  std::ranges::copy_if(values, std::back_inserter(finite),
                       [](double value) { return std::isfinite(value); });
  if (finite.empty()) return {};
  const auto rank = [&](double share) {
    return static_cast<std::size_t>(share * static_cast<double>(finite.size() - 1) + 0.5);
  };
  const std::size_t ranks[] = {rank(0), rank(0.1), rank(0.5), rank(0.9), rank(1)};
  place_ranks(finite, ranks);
  return {finite[ranks[0]], finite[ranks[1]], finite[ranks[2]], finite[ranks[3]], finite[ranks[4]]};
}

void set_knots(PlacedEffect& effect, const std::vector<std::span<const double>>& values) {
  for (std::size_t i = 0; i < effect.form->knots.size(); ++i)
    if (effect.form->knots[i] > 0)
      effect.inputs[i].knots = spline_knots(values[i], effect.form->knots[i]);
}

std::vector<models::Parameter> parameters_of(const PlacedEffect& effect) {
  const EffectForm& form = *effect.form;
  return form.parameters_of ? form.parameters_of(effect) : form.parameters;
}

std::size_t amplitudes_of(const PlacedEffect& effect) {
  return effect.form->parameters_of ? parameters_of(effect).size() : 1;
}

const EffectInput* input_of(const models::Parameter& parameter, const PlacedEffect& effect) {
  const auto symbols = input_symbols(*effect.form);
  const auto at = std::ranges::find(symbols, parameter.unit);
  return at == symbols.end() ? nullptr
                             : &effect.inputs[static_cast<std::size_t>(at - symbols.begin())];
}

std::string unit_of(const models::Parameter& parameter, const PlacedEffect& effect) {
  const EffectInput* input = input_of(parameter, effect);
  if (!input) return parameter.unit;
  if (const data::Quantity* quantity = data::find_quantity(input->column)) return quantity->unit;
  if (const data::DerivedQuantity* quantity = data::find_derived(input->column))
    return quantity->unit;
  return "";
}

Expr formula_of(const PlacedEffect& effect) {
  return effect.form->build ? effect.form->build(effect) : *effect.form->factor;
}

std::vector<std::string> level_names(const PlacedEffect& effect) {
  std::vector<std::string> names = effect.inputs[0].levels;
  if (effect.form->texts < 2) return names;
  names.clear();
  for (const std::string& first : effect.inputs[0].levels)
    for (const std::string& second : effect.inputs[1].levels)
      names.push_back(first + ", " + second);
  return names;
}

std::vector<std::string> input_symbols(const EffectForm& form) {
  std::vector<std::string> names = {"x", "x2", "x3"};
  names.resize(form.columns);
  return names;
}

std::vector<double> start_values(const EffectForm& form, const std::vector<Spread>& spreads) {
  std::vector<double> values(form.parameters.size(), 0.0);
  for (std::size_t i = 0; i < form.shapes.size(); ++i)
    values[i + 1] = form.shapes[i].start(spreads.at(form.shapes[i].input));
  return values;
}

std::vector<std::vector<double>> shapes_to_try(const EffectForm& form,
                                               const std::vector<Spread>& spreads) {
  if (form.grid) return form.grid(spreads.front());
  std::vector<std::vector<double>> all(1);
  for (const Shape& shape : form.shapes) {
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& values : all)
      for (const double value : values_to_try(shape, spreads.at(shape.input))) {
        longer.push_back(values);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

const std::vector<EffectForm>& all_effects() {
  return Registry<EffectForm>::instance().all();
}

const EffectForm* find_effect(std::string_view name) {
  return Registry<EffectForm>::instance().find(name);
}

std::vector<std::string> effect_names() {
  return all_names(all_effects());
}

} // namespace frictab::effects
