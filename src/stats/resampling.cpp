// Sums per experiment and resampling of whole experiments.
#include "stats/resampling.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/random.h"

namespace frictab::stats {

std::vector<ErrorSums> error_sums(std::span<const double> measured,
                                  std::span<const double> predicted,
                                  std::span<const std::size_t> first_row) {
  std::vector<ErrorSums> sums(first_row.size() - 1);
  for (std::size_t e = 0; e < sums.size(); ++e)
    for (std::size_t i = first_row[e]; i < first_row[e + 1]; ++i) {
      const double r = measured[i] - predicted[i];
      sums[e].absolute += std::abs(r);
      sums[e].square += r * r;
      sums[e].residual += r;
      ++sums[e].rows;
    }
  return sums;
}

void add_block(ErrorSums& sums, double r, double rows, double within_MPa2) {
  const double variance = within_MPa2 / rows, s = std::sqrt(variance);
  // The mean of a folded normal distribution (Leone, Nelson and Nottingham 1961).
  const double absolute =
      s > 0 ? s * std::sqrt(2 / std::numbers::pi) * std::exp(-r * r / (2 * variance)) +
                  r * std::erf(r / (s * std::numbers::sqrt2))
            : std::abs(r);
  sums.absolute += rows * absolute;
  sums.square += rows * r * r + within_MPa2;
  sums.residual += rows * r;
  sums.rows += rows;
}

void add_row(ErrorSums& sums, const data::Dataset& data, std::size_t row, double r) {
  add_block(sums, r, data.row_weight(row), data.condensed ? data.condensed->within_MPa2[row] : 0.0);
}

std::vector<ErrorSums> error_sums(const data::Dataset& data, std::span<const double> predicted) {
  const auto measured = data.values("tau_R_MPa");
  std::vector<ErrorSums> sums(data.experiments.size());
  if (!data.condensed) sums = error_sums(measured, predicted, data.first_row);
  for (std::size_t e = 0; e < data.recording.size(); ++e)
    sums[e].recording = data.recording[e];
  for (std::size_t e = 0; data.condensed && e < sums.size(); ++e)
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      add_block(sums[e], measured[i] - predicted[i], data.condensed->rows[i],
                data.condensed->within_MPa2[i]);
  return sums;
}

std::vector<ErrorSums> by_recording(std::span<const ErrorSums> sums) {
  std::vector<ErrorSums> added;
  std::map<std::size_t, std::size_t> place;
  for (const ErrorSums& one : sums) {
    const auto known = place.find(one.recording);
    if (one.recording == no_recording || known == place.end()) {
      place.emplace(one.recording, added.size());
      added.push_back(one);
      continue;
    }
    ErrorSums& all = added[known->second];
    all.absolute += one.absolute;
    all.square += one.square;
    all.residual += one.residual;
    all.rows += one.rows;
  }
  if (added.size() < 2) return {sums.begin(), sums.end()};
  return added;
}

void resample(std::uint64_t seed, std::size_t index, std::span<double> times) {
  Random random(seed, 0x6d65747269630000 + index);
  std::ranges::fill(times, 0.0);
  for (std::size_t e = 0; e < times.size(); ++e)
    ++times[random.below(times.size())];
}

double ratio_of(std::span<const double> x, std::span<const double> n, std::span<const double> times,
                Measure measure, std::span<double> influence) {
  double sum = 0, rows = 0;
  for (std::size_t e = 0; e < x.size(); ++e) {
    sum += times[e] * x[e];
    rows += times[e] * n[e];
  }
  const double mean = sum / rows;
  double value = mean, slope = 1; // derivative by the mean
  if (measure == Measure::root_mean) {
    value = std::sqrt(mean);
    slope = value > 0 ? 0.5 / value : 0;
  }
  for (std::size_t e = 0; e < x.size(); ++e)
    influence[e] = slope * (x[e] - mean * n[e]) / rows;
  return value;
}

double standard_error(std::span<const double> influence, std::span<const double> times) {
  double sum = 0;
  for (std::size_t e = 0; e < influence.size(); ++e)
    sum += times[e] * influence[e] * influence[e];
  const double experiments = static_cast<double>(influence.size());
  return std::sqrt(sum * experiments / (experiments - 1));
}

double quantile_of(std::vector<double>& values, double share) {
  std::ranges::sort(values);
  const double x = share * static_cast<double>(values.size() - 1);
  const auto i = static_cast<std::size_t>(x);
  const double next = values[std::min(i + 1, values.size() - 1)];
  const double part = x - static_cast<double>(i);
  return part == 0 || next == values[i] ? values[i] : values[i] + part * (next - values[i]);
}

} // namespace frictab::stats
