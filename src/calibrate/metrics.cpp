// MAE, RMSE and bias, and their intervals from resampled experiments.
#include "calibrate/metrics.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace frictab {

namespace {

struct Sums {
  double absolute = 0;
  double square = 0;
  double residual = 0;
  double rows = 0;
  void add(const Sums& other) {
    absolute += other.absolute;
    square += other.square;
    residual += other.residual;
    rows += other.rows;
  }
};

Interval percentile_interval(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const double x = share * static_cast<double>(values.size() - 1);
    const auto i = static_cast<std::size_t>(x);
    const double next = values[std::min(i + 1, values.size() - 1)];
    return values[i] + (x - static_cast<double>(i)) * (next - values[i]);
  };
  return {at(0.025), at(0.975)};
}

} // namespace

Metrics metrics(std::span<const double> measured, std::span<const double> predicted,
                std::span<const std::size_t> first_row, std::size_t resamples, std::uint64_t seed) {
  const std::size_t experiments = first_row.size() - 1;
  std::vector<Sums> parts(experiments);
  Sums all;
  for (std::size_t e = 0; e < experiments; ++e) {
    for (std::size_t i = first_row[e]; i < first_row[e + 1]; ++i) {
      const double r = measured[i] - predicted[i];
      parts[e].add({std::abs(r), r * r, r, 1});
    }
    all.add(parts[e]);
  }
  Metrics m;
  m.n_rows = first_row.back();
  m.n_experiments = experiments;
  m.mae_MPa = all.absolute / all.rows;
  m.rmse_MPa = std::sqrt(all.square / all.rows);
  m.bias_MPa = all.residual / all.rows;
  std::vector<double> mae, rmse, bias;
  Random random(seed, 0x6d6574726963);
  for (std::size_t b = 0; b < resamples; ++b) {
    Sums sums;
    for (std::size_t e = 0; e < experiments; ++e)
      sums.add(parts[random.below(experiments)]);
    mae.push_back(sums.absolute / sums.rows);
    rmse.push_back(std::sqrt(sums.square / sums.rows));
    bias.push_back(sums.residual / sums.rows);
  }
  if (resamples > 0) {
    m.mae_interval = percentile_interval(mae);
    m.rmse_interval = percentile_interval(rmse);
    m.bias_interval = percentile_interval(bias);
  }
  return m;
}

} // namespace frictab
