// Factors between experiments and law, and the laws at their quantiles.
#include "calibrate/band.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/no_value.h"

namespace frictab::calibrate {

std::vector<double> experiment_gains(const data::Dataset& data, std::span<const double> predicted) {
  const auto measured = data.values("tau_R_MPa");
  std::vector<double> gains;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    double cross = 0, square = 0;
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i) {
      cross += data.row_weight(i) * measured[i] * predicted[i];
      square += data.row_weight(i) * predicted[i] * predicted[i];
    }
    gains.push_back(square > 0 ? cross / square : no_value);
  }
  return gains;
}

std::vector<double> gains_of_new_experiments(std::vector<double> gains, std::size_t parameters) {
  std::erase_if(gains, [](double g) { return !(g > 0) || !std::isfinite(g); });
  std::ranges::sort(gains);
  if (gains.size() <= parameters) return {};
  const double count = static_cast<double>(gains.size());
  const double wider = std::sqrt(count / (count - static_cast<double>(parameters)));
  const std::size_t half = gains.size() / 2;
  const double median = gains.size() % 2 ? gains[half] : std::sqrt(gains[half - 1] * gains[half]);
  for (double& gain : gains)
    gain = median * std::pow(gain / median, wider);
  return gains;
}

std::optional<double> gain_at_quantile(std::span<const double> gains, double quantile) {
  constexpr double rounding = 1e-12; // 0.05 of 19 experiments is exactly the first one
  const double rank = quantile * (static_cast<double>(gains.size()) + 1) - 1;
  const double last = static_cast<double>(gains.size()) - 1;
  if (gains.empty() || rank < -rounding || rank > last + rounding) return std::nullopt;
  const double at = std::clamp(rank, 0.0, last);
  const auto i = static_cast<std::size_t>(at);
  const double next = gains[std::min(i + 1, gains.size() - 1)];
  return gains[i] * std::pow(next / gains[i], at - static_cast<double>(i));
}

models::Model at_quantile(const models::Model& model, double quantile, const Place& place) {
  models::Model end = model;
  end.quantile = quantile;
  if (quantile == 0.5) return end;
  const auto gain = gain_at_quantile(model.experiment_gains, quantile);
  if (!gain) {
    const std::size_t experiments = model.experiment_gains.size();
    const auto count = static_cast<double>(experiments);
    throw InputError(place,
                     fmt::format("{} experiments do not give the quantile {} of '{}'", experiments,
                                 quantile, model.law->name),
                     experiments == 0
                         ? "calibrate this law, fixed or not, on experiments first"
                         : fmt::format("between {:.3g} and {:.3g}, or more experiments",
                                       1 / (count + 1), count / (count + 1)));
  }
  end.gain = *gain;
  return end;
}

BandCheck check_band(const models::Model& model, std::span<const double> predicted,
                     const data::Dataset& data) {
  return check_band(model, data.experiments.empty() ? std::vector<double>{}
                                                    : experiment_gains(data, predicted));
}

BandCheck check_band(const models::Model& model, std::span<const double> gains) {
  BandCheck check{gain_at_quantile(model.experiment_gains, 0.05),
                  gain_at_quantile(model.experiment_gains, 0.95), 0, gains.size()};
  if (!check.low || !check.high) return check;
  for (const double gain : gains)
    if (gain >= *check.low && gain <= *check.high) ++check.inside;
  return check;
}

} // namespace frictab::calibrate
