// Source rows of a block, and the uncertainty of its stress.
#include "calibrate/fit_weights.h"

#include <algorithm>

namespace frictab::calibrate {

namespace {

constexpr const char* uncertainty = "tau_R_error_MPa";

} // namespace

bool has_uncertainties(const data::Dataset& data) {
  if (!data.has(uncertainty) || data.rows() == 0) return false;
  const auto [low, high] =
      std::minmax_element(data.values(uncertainty).begin(), data.values(uncertainty).end());
  return *low < *high;
}

std::vector<double> fit_weights(const data::Dataset& data) {
  const auto rows = data.row_weights();
  std::vector<double> weights(rows.begin(), rows.end());
  if (!has_uncertainties(data)) return weights;
  const auto u = data.values(uncertainty);
  double sum = 0, count = 0;
  weights.resize(data.rows());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = data.row_weight(i) / (u[i] * u[i]);
    sum += weights[i];
    count += data.row_weight(i);
  }
  for (double& weight : weights)
    weight *= count / sum;
  return weights;
}

} // namespace frictab::calibrate
