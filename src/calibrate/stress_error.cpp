// Derivatives of the law's formula, combined with its covariance.
#include "calibrate/stress_error.h"

#include <cmath>

#include "core/no_value.h"

namespace frictab::calibrate {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

expr::Program program_of(const models::Model& model, std::vector<std::string> columns) {
  models::Conventions unlimited = model.conventions;
  unlimited.shear_limit = false;
  for (const std::string& name : models::parameter_names(*model.law))
    columns.push_back(name);
  return {models::tau_formula(*model.law, unlimited), std::move(columns), {}};
}

} // namespace

StressError::StressError(const models::Model& model, const std::vector<std::string>& inputs)
    : parameters_(model.parameters), program_(program_of(model, inputs)) {
  const Index size = parameters_.size();
  if (model.covariance.size() != parameters_.size() * parameters_.size()) return;
  covariance_ = Eigen::Map<const Eigen::MatrixXd>(model.covariance.data(), size, size); // symmetric
  known_ = true;
}

std::optional<VectorXd> StressError::slope(std::span<const double> state) const {
  std::vector<double> row(state.begin(), state.end());
  row.insert(row.end(), parameters_.begin(), parameters_.end());
  std::vector<double> by(row.size());
  const double tau = program_.gradient(row, {}, by);
  const VectorXd slope =
      Eigen::Map<const VectorXd>(by.data() + state.size(), parameters_.size()) / tau;
  if (!(tau > 0) || !std::isfinite(tau) || !slope.allFinite()) return std::nullopt;
  return slope;
}

VectorXd StressError::with(const VectorXd& slope) const {
  VectorXd sum = VectorXd::Zero(slope.size());
  for (Index p = 0; p < slope.size(); ++p)
    if (slope(p) != 0) sum += slope(p) * covariance_.col(p);
  return sum;
}

double StressError::of(const VectorXd& slope) const {
  const VectorXd covariances = with(slope);
  double square = 0;
  for (Index p = 0; p < slope.size(); ++p)
    if (slope(p) != 0) square += slope(p) * covariances(p);
  return std::isnan(square) ? square : std::sqrt(std::max(0.0, square));
}

std::optional<double> StressError::at(std::span<const double> state) const {
  const auto g = known_ ? slope(state) : std::nullopt;
  const double error = g ? of(*g) : no_value;
  return std::isnan(error) ? std::nullopt : std::optional(error);
}

} // namespace frictab::calibrate
