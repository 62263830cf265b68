// MAE, RMSE and bias, and their intervals from resampled experiments.
#include "calibrate/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/no_value.h"

namespace frictab::calibrate {

namespace {

constexpr std::size_t enough_experiments = 6;
// 97.5 % quantiles of Student's t for 1 to 4 degrees of freedom.
constexpr std::array<double, 4> student = {12.7062, 4.3027, 3.1824, 2.7764};

struct Draws {
  std::size_t count;
  std::uint64_t seed;
};

struct Estimate {
  double value = 0;
  Interval interval;
};

std::vector<double> column_of(std::span<const stats::ErrorSums> sums,
                              double stats::ErrorSums::*member) {
  std::vector<double> values;
  for (const stats::ErrorSums& one : sums)
    values.push_back(one.*member);
  return values;
}

// Infinite if the error is only rounding of `size`: a resample that drew one experiment every time
// has no scatter.
double in_standard_errors(double step, double error, double size) {
  if (error > 1e-12 * size) return step / error;
  if (step == 0 || std::isnan(step)) return 0;
  return std::copysign(std::numeric_limits<double>::infinity(), step);
}

// The 2.5 % and 97.5 % quantiles of (resampled - value) / resampled standard error.
Interval studentised(std::span<const double> x, std::span<const double> n, stats::Measure measure,
                     double value, Draws draws) {
  std::vector<double> t, influence(x.size()), times(x.size());
  for (std::size_t b = 0; b < draws.count; ++b) {
    stats::resample(draws.seed, b, times);
    const double again = stats::ratio_of(x, n, times, measure, influence);
    const double se = stats::standard_error(influence, times);
    t.push_back(in_standard_errors(again - value, se, std::abs(again)));
  }
  const double low = stats::quantile_of(t, 0.025); // sorts
  return {low, stats::quantile_of(t, 0.975)};
}

Estimate estimate(const std::vector<double>& x, const std::vector<double>& n,
                  stats::Measure measure, Draws draws) {
  Estimate result{0, {no_value, no_value}};
  std::vector<double> influence(x.size());
  const std::vector<double> once(x.size(), 1.0);
  result.value = stats::ratio_of(x, n, once, measure, influence);
  if (x.size() < 2 || draws.count == 0) return result;
  const double se = stats::standard_error(influence, once);
  Interval t;
  if (x.size() < enough_experiments)
    t = {-student[x.size() - 2], student[x.size() - 2]};
  else
    t = studentised(x, n, measure, result.value, draws);
  // without scatter, t is infinite and has nothing to multiply
  result.interval = se > 0 ? Interval{result.value - t.high * se, result.value - t.low * se}
                           : Interval{result.value, result.value};
  return result;
}

// Clamps to 0, because an error is not negative even if the interval's formula gives that.
Interval not_negative(Interval interval) {
  return {std::isnan(interval.low) ? interval.low : std::max(0.0, interval.low), interval.high};
}

} // namespace

Metrics metrics(std::span<const stats::ErrorSums> of_tests, std::size_t resamples,
                std::uint64_t seed) {
  const std::vector<stats::ErrorSums> sums = stats::by_recording(of_tests);
  const Draws draws{resamples, seed};
  const auto rows = column_of(sums, &stats::ErrorSums::rows);
  const Estimate mae =
      estimate(column_of(sums, &stats::ErrorSums::absolute), rows, stats::Measure::mean, draws);
  const Estimate rmse =
      estimate(column_of(sums, &stats::ErrorSums::square), rows, stats::Measure::root_mean, draws);
  const Estimate bias =
      estimate(column_of(sums, &stats::ErrorSums::residual), rows, stats::Measure::mean, draws);
  Metrics m;
  m.mae_MPa = mae.value;
  m.rmse_MPa = rmse.value;
  m.bias_MPa = bias.value;
  m.mae_interval = not_negative(mae.interval);
  m.rmse_interval = not_negative(rmse.interval);
  m.bias_interval = bias.interval;
  for (const stats::ErrorSums& one : sums)
    m.n_rows += static_cast<std::size_t>(one.rows);
  m.n_experiments = of_tests.size();
  return m;
}

Metrics metrics(const data::Dataset& data, std::span<const double> predicted, std::size_t resamples,
                std::uint64_t seed) {
  return metrics(stats::error_sums(data, predicted), resamples, seed);
}

Metrics metrics(std::span<const double> measured, std::span<const double> predicted,
                std::span<const std::size_t> first_row, std::size_t resamples, std::uint64_t seed) {
  return metrics(stats::error_sums(measured, predicted, first_row), resamples, seed);
}

double mean_stress_MPa(const data::Dataset& data) {
  const auto tau = data.values("tau_R_MPa");
  double sum = 0;
  for (const double one : tau)
    sum += std::abs(one);
  return tau.empty() ? 0 : sum / static_cast<double>(tau.size());
}

} // namespace frictab::calibrate
