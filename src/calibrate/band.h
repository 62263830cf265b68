// Band in which experiments lie around a law. Tests differ by a factor that no input explains
// (lubricant, tool, batch); a simulation can be run with the law at either end of the band. Its
// ends are order statistics of the factors of the training experiments, without an assumption about
// their distribution.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/error.h"
#include "data/dataset.h"
#include "models/law.h"

namespace frictab::calibrate {

// Returns the least-squares factor of each experiment: sum(measured predicted)/sum(predicted^2).
// NaN where the law predicts no stress at all.
std::vector<double> experiment_gains(const data::Dataset& data, std::span<const double> predicted);

// Widens the factors about their median to the spread of new experiments: a fit of `parameters`
// numbers to E experiments has adapted the law to these, so that their logarithms scatter too
// little, by sqrt((E - parameters)/E). Returns them in ascending order, without factors that are
// not positive.
std::vector<double> gains_of_new_experiments(std::vector<double> gains, std::size_t parameters);

// Factor that a share `quantile` of new experiments stays below, interpolated between order
// statistics linearly in the logarithm; none with too few experiments. A new experiment lies below
// the k-th smallest of E factors with probability k/(E+1), for any distribution (Wilks 1941).
std::optional<double> gain_at_quantile(std::span<const double> gains, double quantile);

// Returns the law at a quantile of the experiments; 0.5 is the law itself. Throws InputError (at
// `place`) if there are too few experiments for it.
models::Model at_quantile(const models::Model& model, double quantile, const Place& place);

// Coverage of the 5 %..95 % band on experiments not trained on.
struct BandCheck {
  std::optional<double> low; // factors; none with too few experiments
  std::optional<double> high;
  std::size_t inside = 0; // experiments of `data` with their own factor inside
  std::size_t experiments = 0;
};
BandCheck check_band(const models::Model& model, std::span<const double> predicted,
                     const data::Dataset& data);
// The same from the experiments' own factors; without any, the ends of the band alone.
BandCheck check_band(const models::Model& model, std::span<const double> gains = {});

} // namespace frictab::calibrate
