// Sums of errors per experiment, and resampling of whole experiments, identical for every law.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "data/dataset.h"

namespace frictab::stats {

inline constexpr std::size_t no_recording = static_cast<std::size_t>(-1);

// Sums over the rows of one experiment; residual r = measured - predicted in MPa.
struct ErrorSums {
  double absolute = 0; // |r|
  double square = 0;   // r^2
  double residual = 0; // r
  double rows = 0;
  std::size_t recording = no_recording; // index in data::Dataset
};

// One entry per experiment; first_row has experiments + 1 entries.
std::vector<ErrorSums> error_sums(std::span<const double> measured,
                                  std::span<const double> predicted,
                                  std::span<const std::size_t> first_row);

// Sums errors of the data's tau_R_MPa. A block of condensed rows counts as its rows: their squares
// and sums are exact to second order; |r| assumes normal scatter about the block's residual.
std::vector<ErrorSums> error_sums(const data::Dataset& data, std::span<const double> predicted);

// Adds up experiments of one recording, because they are resampled together; unchanged if fewer
// than two recordings would remain.
std::vector<ErrorSums> by_recording(std::span<const ErrorSums> sums);

// Adds `rows` rows that scatter with the sum of squares `within` about the residual r.
void add_block(ErrorSums& sums, double r, double rows, double within_MPa2);
// Adds the residual r of a row of the data, or of a block of condensed rows.
void add_row(ErrorSums& sums, const data::Dataset& data, std::size_t row, double r);

// Draws resample number `index` with replacement: how often it contains each experiment (one entry
// of `times` each). The same seed, index and number of experiments give the same counts, so laws on
// the same data are resampled alike (paired).
void resample(std::uint64_t seed, std::size_t index, std::span<double> times);

// Computes a ratio of sums over experiments, or its root, in one resample: value = f(sum x / sum
// n), with the influence of each experiment on it (infinitesimal jackknife). sqrt(E/(E-1) sum times
// influence^2) is its standard error.
enum class Measure { mean, root_mean };
double ratio_of(std::span<const double> x, std::span<const double> n, std::span<const double> times,
                Measure measure, std::span<double> influence);
double standard_error(std::span<const double> influence, std::span<const double> times);

// Quantile by linear interpolation between order statistics; sorts `values`.
double quantile_of(std::vector<double>& values, double share);

} // namespace frictab::stats
