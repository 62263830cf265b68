// How an effect looks where it was tested, and between.
#include "trace/plausibility.h"

#include <algorithm>
#include <cmath>

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

// Rows of inputs in which all but the first are at one of their ends.
std::vector<std::vector<double>> corners_of(const PlacedEffect& effect) {
  std::vector<std::vector<double>> rows{{0.0}};
  for (std::size_t i = 1; i < effect.inputs.size(); ++i) {
    std::vector<std::vector<double>> longer;
    for (const auto& row : rows)
      for (const double end : {effect.inputs[i].low, effect.inputs[i].high}) {
        longer.push_back(row);
        longer.back().push_back(end);
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
  const auto at_corners = [&](double x, auto take) {
    for (std::vector<double> row : corners) {
      row.front() = x;
      take(program(row, at));
    }
  };
  at_corners(column.tested.front(),
             [&](double f) { look.low = look.high = look.tested_low = look.tested_high = f; });
  constexpr int steps = 32;
  const EffectInput& x = effect.inputs[0];
  for (int i = 0; i <= steps; ++i)
    at_corners(x.low + (x.high - x.low) * i / steps, [&](double f) { look.take(f); });
  for (const double tested : column.tested)
    at_corners(tested, [&](double f) {
      look.tested_low = std::min(look.tested_low, f);
      look.tested_high = std::max(look.tested_high, f);
    });
  return look;
}

// Two things fit as well as the truth at the tested values, and nowhere else: large changes that
// cancel there (an effect that halves or doubles friction has to earn it, as if changes were normal
// with a standard deviation of 50 %), and humps between them.
} // namespace

double implausibility(const PlacedEffect& effect, const CandidateColumn& column) {
  const Look look = look_of(effect, column);
  if (!std::isfinite(look.largest)) return 1e6;
  const double tested = look.tested_high - look.tested_low;
  const double beyond = (look.high - look.low - tested) / std::max(tested, 1e-6);
  return 2 * look.largest * look.largest + 8 * std::clamp(beyond - 0.3, 0.0, 10.0);
}

} // namespace frictab
