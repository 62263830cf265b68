// The restricted likelihood from its sums, its dense evaluation, and the search by logarithms.
#include "stats/reml.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <nlopt.hpp>

namespace frictab::stats {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RestrictedSolution::RestrictedSolution(const RestrictedSums& sums)
    : factor(sums.information), along(sums.right) {
  factor.matrixL().solveInPlace(along);
  const double log_information = 2 * factor.matrixLLT().diagonal().array().log().sum();
  criterion = (sums.log_determinants + (sums.squares - along.squaredNorm() + log_information)) / 2;
}

DenseReml::DenseReml(const RemlRows& rows, const std::function<MatrixXd(std::size_t)>& covariance,
                     VectorXd precision)
    : rows_(rows), precision_(std::move(precision)), weighted_(rows.experiments()),
      sums_(sums(covariance)), solution_(sums_),
      coefficients_(solution_.factor.matrixU().solve(solution_.along)) {}

RestrictedSums DenseReml::sums(const std::function<MatrixXd(std::size_t)>& covariance) {
  const Index size = rows_.design.cols();
  RestrictedSums sums{MatrixXd::Zero(size, size), VectorXd::Zero(size)};
  for (std::size_t e = 0; e < weighted_.size(); ++e) {
    const Eigen::LLT<MatrixXd> v(covariance(e));
    Weighted& w = weighted_[e];
    w.inverse = v.solve(MatrixXd::Identity(v.rows(), v.cols()));
    w.design = w.inverse * design(e);
    sums.information += design(e).transpose() * w.design;
    sums.right += w.design.transpose() * y(e);
    sums.squares += y(e).dot(w.inverse * y(e));
    sums.log_determinants += 2 * v.matrixLLT().diagonal().array().log().sum();
  }
  sums.information.diagonal() += precision_;
  for (const double precision : precision_)
    if (precision > 0) sums.log_determinants -= std::log(precision);
  return sums;
}

VectorXd DenseReml::without(std::size_t e) const {
  const MatrixXd& a = weighted_[e].design;
  return (sums_.information - a.transpose() * design(e))
      .ldlt()
      .solve(sums_.right - a.transpose() * y(e));
}

// (P - W r r' W)/2 with r = y - A b and P = W - W A (A'WA + T^-1)^-1 A'W.
MatrixXd DenseReml::slope(std::size_t e) const {
  const MatrixXd half = solution_.factor.matrixL().solve(weighted_[e].design.transpose());
  const VectorXd r = weighted_[e].inverse * (y(e) - design(e) * coefficients_);
  return (weighted_[e].inverse - half.transpose() * half - r * r.transpose()) / 2;
}

VectorXd DenseReml::ridge_slopes() const {
  const Index size = coefficients_.size();
  const VectorXd variance =
      solution_.factor.solve(MatrixXd::Identity(size, size)).diagonal(); // of each coefficient
  return (precision_.array() > 0)
      .select(1 - precision_.array() * (variance.array() + coefficients_.array().square()), 0.0);
}

double LogPrior::operator()(std::span<const double> logs, std::span<double> gradient) const {
  double sum = 0;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    const double away = logs[k] - centre[k];
    sum += precision * away * away / 2;
    if (!gradient.empty()) gradient[k] += precision * away;
  }
  return sum;
}

LogMinimum least_criterion(const Criterion& criterion, std::vector<double> start,
                           const LogSearch& search) {
  LogMinimum best{std::move(start)};
  const auto value = [&](std::span<const double> logs, std::span<double> gradient) {
    const double found = criterion(logs, gradient) + search.prior(logs, gradient);
    return std::isfinite(found) ? found : 1e300;
  };
  Criterion counted = [&](std::span<const double> logs, std::span<double> gradient) {
    ++best.evaluations;
    return value(logs, gradient);
  };
  nlopt::opt optimiser(search.has_gradient ? nlopt::LD_SLSQP : nlopt::LN_BOBYQA,
                       static_cast<unsigned>(best.logs.size()));
  optimiser.set_lower_bounds(search.low);
  optimiser.set_upper_bounds(search.high);
  if (search.first_step > 0) optimiser.set_initial_step(search.first_step);
  optimiser.set_maxeval(search.most_evaluations);
  optimiser.set_ftol_abs(search.tolerance);
  optimiser.set_xtol_abs(search.log_tolerance);
  optimiser.set_min_objective(
      [](const std::vector<double>& logs, std::vector<double>& gradient, void* data) {
        return (*static_cast<Criterion*>(data))(logs, gradient);
      },
      &counted);
  try {
    optimiser.optimize(best.logs, best.criterion);
  } catch (
      const std::runtime_error&) { // no further improvement; the logarithms are the best so far
    best.criterion = value(best.logs, {});
  }
  return best;
}

} // namespace frictab::stats
