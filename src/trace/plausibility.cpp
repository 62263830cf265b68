// How an effect looks where it was tested, and between.
#include "trace/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace frictab {

namespace {

// How an effect's factor looks: over its whole range, and where it was tested.
struct Look {
  double largest = 0; // change of friction
  double low = 1, high = 1, tested_low = 1, tested_high = 1;

  void take(double factor) {
    largest = std::max(largest, std::abs(factor - 1));
    low = std::min(low, factor);
    high = std::max(high, factor);
  }
};

// The first input of numbers: the one that is run through.
std::size_t running_input(const PlacedEffect& effect) {
  return effect.inputs[0].levels.empty() ? 0 : 1;
}

// Rows of inputs in which all others are at one of their ends, or levels.
std::vector<std::vector<double>> corners_of(const PlacedEffect& effect) {
  std::vector<std::vector<double>> rows{{}};
  for (std::size_t i = 0; i < effect.inputs.size(); ++i) {
    const EffectInput& input = effect.inputs[i];
    std::vector<double> places = {input.low, input.high};
    if (i == running_input(effect)) places.pop_back();
    if (!input.levels.empty()) {
      places.resize(input.levels.size());
      std::iota(places.begin(), places.end(), 0.0);
    }
    std::vector<std::vector<double>> longer;
    for (const auto& row : rows)
      for (const double place : places) {
        longer.push_back(row);
        longer.back().push_back(place);
      }
    rows = std::move(longer);
  }
  return rows;
}

Look look_of(const PlacedEffect& effect, const CandidateColumn& column) {
  Look look;
  if (effect.form->categorical && effect.form->columns == 1) {
    for (const double a : fitted_values(effect))
      look.largest = std::max(look.largest, std::abs(a));
    return look;
  }
  const Program program = factor_program(effect);
  const std::vector<double> at = fitted_values(effect);
  const auto corners = corners_of(effect);
  const std::size_t running = running_input(effect);
  const EffectInput& x = effect.inputs[running];
  constexpr int steps = 32;
  std::vector<double> places;
  for (int i = 0; i <= steps; ++i)
    places.push_back(x.low + (x.high - x.low) * i / steps);
  const auto& tested_at = x.column == column.name ? column.tested : places;
  const auto at_corners = [&](double place, auto take) {
    for (std::vector<double> row : corners) {
      row[running] = place;
      take(program(row, at));
    }
  };
  at_corners(tested_at.front(),
             [&](double f) { look.low = look.high = look.tested_low = look.tested_high = f; });
  for (const double place : places)
    at_corners(place, [&](double f) { look.take(f); });
  for (const double tested : tested_at)
    at_corners(tested, [&](double f) {
      look.tested_low = std::min(look.tested_low, f);
      look.tested_high = std::max(look.tested_high, f);
    });
  return look;
}

} // namespace

// Two things fit as well as the truth at the tested values, and nowhere else: large changes that
// cancel there (an effect that halves or doubles friction has to earn it, as if changes were normal
// with a standard deviation of 50 %), and humps between them.
double implausibility(const PlacedEffect& effect, const CandidateColumn& column) {
  const Look look = look_of(effect, column);
  if (!std::isfinite(look.largest)) return 1e6;
  const double tested = look.tested_high - look.tested_low;
  const double beyond = (look.high - look.low - tested) / std::max(tested, 1e-6);
  return 2 * look.largest * look.largest + 8 * std::clamp(beyond - 0.3, 0.0, 10.0);
}

} // namespace frictab
