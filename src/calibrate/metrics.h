// Errors of prediction with intervals by experiment.
#pragma once

#include <cstdint>
#include <span>

#include "calibrate/judgement.h"
#include "stats/resampling.h"

namespace frictab::calibrate {

// Computes errors with intervals: bootstrap-t over whole experiments (Efron 1981; Davison and
// Hinkley 1997, ch. 5), equal tails. Chosen by simulation: in 1500 campaigns whose experiments
// differ by a gain of 8.6 %, nominal 95 % intervals of the MAE contained the true value in
//   experiments        6     10     30     81
//   percentile        83 %   87 %   93 %   94 %
//   BCa               84 %   88 %   94 %   95 %
//   bootstrap-t       94 %   94 %   96 %   95 %
// of the cases. Below 6 experiments too few different resamples exist, so Student's t with
// experiments - 1 degrees of freedom is used. One experiment, or resamples = 0: no interval (NaN).
// first_row has experiments + 1 entries. The resamples depend only on the seed and the number of
// experiments, so two laws on the same data are resampled alike (paired).
Metrics metrics(std::span<const double> measured, std::span<const double> predicted,
                std::span<const std::size_t> first_row, std::size_t resamples, std::uint64_t seed);
Metrics metrics(const data::Dataset& data, std::span<const double> predicted, std::size_t resamples,
                std::uint64_t seed);
// The same from sums per test. Intervals of one recording are drawn together, as one experiment.
Metrics metrics(std::span<const stats::ErrorSums> of_tests, std::size_t resamples,
                std::uint64_t seed);

// Mean of |tau_R| over all rows, in MPa: what errors are compared with.
double mean_stress_MPa(const data::Dataset& data);

} // namespace frictab::calibrate
