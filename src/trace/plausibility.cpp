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

Look look_of(const PlacedEffect& effect, const CandidateColumn& column) {
  Look look;
  if (effect.form->categorical) {
    for (const double a : fitted_values(effect))
      look.largest = std::max(look.largest, std::abs(a));
    return look;
  }
  const Program program = factor_program(effect);
  const std::vector<double> at = fitted_values(effect);
  const auto factor = [&](double x, double x2) {
    const double row[] = {x, x2};
    return program({row, effect.form->two_columns ? 2u : 1u}, at);
  };
  look.low = look.high = look.tested_low = look.tested_high =
      factor(column.tested.front(), effect.low2);
  constexpr int steps = 32;
  for (int i = 0; i <= steps; ++i)
    for (const double x2 : {effect.low2, effect.high2})
      look.take(factor(effect.low + (effect.high - effect.low) * i / steps, x2));
  for (const double x : column.tested)
    for (const double x2 : {effect.low2, effect.high2}) {
      look.tested_low = std::min(look.tested_low, factor(x, x2));
      look.tested_high = std::max(look.tested_high, factor(x, x2));
    }
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
