// Looks up effect forms and starts their shape parameters from the data.
#include "effects/effect.h"

#include <algorithm>
#include <cmath>

namespace frictab {

double Spread::span() const {
  if (high > low) return high - low;
  if (maximum > minimum) return maximum - minimum;
  return std::abs(median) > 0 ? std::abs(median) : 1.0;
}

double Spread::positive() const {
  return median > 0 ? median : span();
}

Spread spread_of(std::span<const double> values) {
  std::vector<double> sorted;
  sorted.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(sorted),
               [](double value) { return std::isfinite(value); });
  if (sorted.empty()) return {};
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](double share) {
    return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
  };
  return {sorted.front(), quantile(0.1), quantile(0.5), quantile(0.9), sorted.back()};
}

std::vector<Parameter> parameters_of(const PlacedEffect& effect) {
  const EffectForm& form = *effect.form;
  return form.parameters_of ? form.parameters_of(effect) : form.parameters;
}

std::size_t amplitudes_of(const PlacedEffect& effect) {
  return effect.form->parameters_of ? parameters_of(effect).size() : effect.form->amplitudes;
}

Expr formula_of(const PlacedEffect& effect) {
  return effect.form->build ? effect.form->build(effect) : effect.form->factor();
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

std::vector<double> places_to_try(const Spread& spread, int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i)
    places.push_back(spread.minimum +
                     (spread.maximum - spread.minimum) * (0.05 + 0.9 * (i + 0.5) / count));
  return places;
}

const std::vector<EffectForm>& all_effects() {
  return Registry<EffectForm>::instance().all();
}

const EffectForm* find_effect(std::string_view name) {
  return Registry<EffectForm>::instance().find(name);
}

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const EffectForm& form : all_effects())
    names.push_back(form.name);
  return names;
}

} // namespace frictab
