// Range of an effect's factor where it was tested, and between.
#include "trace/search/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "trace/tuning.h"

namespace frictab::trace {

namespace {

// Range of an effect's factor over its whole domain, and at tested values.
struct FactorRange {
  double largest = 0; // largest change of friction
  double low = 1, high = 1, tested_low = 1, tested_high = 1;

  void include(double factor) {
    largest = std::max(largest, std::abs(factor - 1));
    low = std::min(low, factor);
    high = std::max(high, factor);
  }
};

// Index of the first numeric input, along which the factor is evaluated.
std::size_t running_input(const effects::PlacedEffect& effect) {
  return effect.inputs[0].levels.empty() ? 0 : 1;
}

// Rows of inputs in which all other inputs are at one of their ends or levels.
std::vector<std::vector<double>> corners_of(const effects::PlacedEffect& effect) {
  std::vector<std::vector<double>> rows{{}};
  for (std::size_t i = 0; i < effect.inputs.size(); ++i) {
    const effects::EffectInput& input = effect.inputs[i];
    std::vector<double> positions = {input.low, input.high};
    if (i == running_input(effect)) positions.pop_back();
    if (!input.levels.empty()) {
      positions.resize(input.levels.size());
      std::iota(positions.begin(), positions.end(), 0.0);
    }
    std::vector<std::vector<double>> longer;
    for (const auto& row : rows)
      for (const double position : positions) {
        longer.push_back(row);
        longer.back().push_back(position);
      }
    rows = std::move(longer);
  }
  return rows;
}

FactorRange factor_range(const effects::PlacedEffect& effect, const CandidateColumn& column) {
  FactorRange range;
  if (effect.form->categorical && effect.form->columns == 1) {
    for (const double a : effects::fitted_values(effect))
      range.largest = std::max(range.largest, std::abs(a));
    return range;
  }
  const expr::Program program = effects::factor_program(effect);
  const std::vector<double> at = effects::fitted_values(effect);
  const auto corners = corners_of(effect);
  const std::size_t running = running_input(effect);
  const effects::EffectInput& x = effect.inputs[running];
  std::vector<double> positions;
  for (int i = 0; i <= tuning::plausibility_intervals; ++i)
    positions.push_back(x.low + (x.high - x.low) * i / tuning::plausibility_intervals);
  const auto& tested_at = x.column == column.name ? column.tested : positions;
  const auto at_corners = [&](double position, auto take) {
    for (std::vector<double> row : corners) {
      row[running] = position;
      take(program(row, at));
    }
  };
  at_corners(tested_at.front(),
             [&](double f) { range.low = range.high = range.tested_low = range.tested_high = f; });
  for (const double position : positions)
    at_corners(position, [&](double f) { range.include(f); });
  for (const double tested : tested_at)
    at_corners(tested, [&](double f) {
      range.tested_low = std::min(range.tested_low, f);
      range.tested_high = std::max(range.tested_high, f);
    });
  return range;
}

} // namespace

// Two kinds of effect can fit at the tested values as well as the true one: large changes that
// cancel there, and humps between those values. Both are penalised.
double implausibility(const effects::PlacedEffect& effect, const CandidateColumn& column) {
  const FactorRange range = factor_range(effect, column);
  if (!std::isfinite(range.largest)) return tuning::infinite_factor_cost;
  const double tested = range.tested_high - range.tested_low;
  const double beyond =
      (range.high - range.low - tested) / std::max(tested, tuning::smallest_tested_range);
  return tuning::large_change_cost * range.largest * range.largest +
         tuning::hump_cost * std::clamp(beyond - tuning::tolerated_hump, 0.0, tuning::largest_hump);
}

} // namespace frictab::trace
