// Restricted maximum likelihood for the polynomial, and the fits without single experiments.
#include "calibrate/polynomial_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <nlopt.hpp>

#include "core/no_value.h"

namespace frictab::calibrate {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t noise_logs = 5;
constexpr double usual_spread = 0.05;
// Standard deviation of the logarithms about their defaults, so wide that it decides only where the
// data are uninformative.
constexpr double prior_width = 10;

unsigned highest_order(const PolynomialProblem& problem) {
  return *std::max_element(problem.order.begin(), problem.order.end());
}

struct LogBounds {
  double low, high;
};

// Upper bound of about a third of the stroke: a slower part could not be distinguished from the
// gain and would absorb it.
LogBounds bounds_of(std::size_t log) {
  if (log == 3) return {std::log(0.02), std::log(0.4)};
  return {std::log(1e-4), std::log(3.0)};
}

std::vector<double> usual_logs(const PolynomialProblem& problem) {
  const PolynomialNoise usual;
  std::vector<double> logs;
  for (const double x : {usual.gain, usual.slope, usual.slow, usual.length, usual.white})
    logs.push_back(std::log(x));
  logs.resize(noise_logs + highest_order(problem), std::log(usual_spread));
  return logs;
}

// V of one experiment and its derivatives by the logarithms of the noise.
struct ExperimentNoise {
  MatrixXd gain, slope, slow, white, by_length;

  ExperimentNoise(const PolynomialNoise& noise, const VectorXd& x, const VectorXd& relative_rows)
      : gain(MatrixXd::Constant(x.size(), x.size(), noise.gain * noise.gain)),
        slope(12 * noise.slope * noise.slope * x * x.transpose()),
        white((noise.white * noise.white / relative_rows.array()).matrix().asDiagonal()) {
    const MatrixXd distance =
        (x.replicate(1, x.size()) - x.transpose().replicate(x.size(), 1)).cwiseAbs() / noise.length;
    slow = noise.slow * noise.slow * (-distance.array()).exp();
    by_length = slow.cwiseProduct(distance);
  }

  MatrixXd sum() const { return gain + slope + slow + white; }
  // Derivatives of V by gain, slope, slow, length, white, in that order: 2, 2, 2, 1, 2 times these.
  std::array<const MatrixXd*, noise_logs> parts() const {
    return {&gain, &slope, &slow, &by_length, &white};
  }
};

PolynomialNoise noise_of(std::span<const double> logs) {
  return {std::exp(logs[0]), std::exp(logs[1]), std::exp(logs[2]), std::exp(logs[3]),
          std::exp(logs[4])};
}

// Solution of the normal equations at one set of standard deviations.
class RidgeSolution {
public:
  RidgeSolution(const PolynomialProblem& problem, std::span<const double> logs)
      : problem_(problem), logs_(logs), noise_(noise_of(logs)),
        matrix_(MatrixXd::Zero(problem.design.cols(), problem.design.cols())),
        right_(VectorXd::Zero(problem.design.cols())), weight_(problem.first.size() - 1) {
    const double mean_rows =
        problem.rows.size() > 0 ? problem.rows.mean() : 1; // the bins that white refers to
    relative_rows_ = problem.rows / mean_rows;
    for (std::size_t e = 0; e < weight_.size(); ++e)
      add(e);
    add_ridge();
    factor_.compute(matrix_);
    coefficients_ = factor_.solve(right_);
  }

  const VectorXd& coefficients() const { return coefficients_; }

  double criterion() const {
    double sum = log_determinants_ + squares_ - right_.dot(coefficients_);
    sum += 2 * factor_.matrixLLT().diagonal().array().log().sum();
    return sum / 2;
  }

  void gradient(std::span<double> out) const {
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t e = 0; e < weight_.size(); ++e)
      add_gradient(e, out);
    const MatrixXd inverse =
        factor_.solve(MatrixXd::Identity(matrix_.rows(), matrix_.cols())); // of A'WA + T^-1
    for (Index c = 1; c < matrix_.cols(); ++c) {
      const double precision = precision_of(c);
      out[noise_logs + problem_.order[static_cast<std::size_t>(c)] - 1] +=
          1 - precision * (inverse(c, c) + coefficients_(c) * coefficients_(c));
    }
  }

  VectorXd without(std::size_t experiment) const {
    const MatrixXd& a = weighted(experiment);
    const auto [from, count] = bins_of(experiment);
    return (matrix_ - a.transpose() * problem_.design.middleRows(from, count))
        .ldlt()
        .solve(right_ - a.transpose() * problem_.ln_mu.segment(from, count));
  }

private:
  struct Weight {
    MatrixXd inverse; // V^-1
    MatrixXd design;  // V^-1 A
  };

  std::pair<Index, Index> bins_of(std::size_t e) const {
    return {problem_.first[e], problem_.first[e + 1] - problem_.first[e]};
  }
  const MatrixXd& weighted(std::size_t e) const { return weight_[e].design; }

  ExperimentNoise noise_in(std::size_t e) const {
    const auto [from, count] = bins_of(e);
    return {noise_, problem_.position.segment(from, count), relative_rows_.segment(from, count)};
  }

  double precision_of(Index column) const {
    return std::exp(-2 * logs_[noise_logs + problem_.order[static_cast<std::size_t>(column)] - 1]);
  }

  void add(std::size_t e) {
    const auto [from, count] = bins_of(e);
    const auto a = problem_.design.middleRows(from, count);
    const auto y = problem_.ln_mu.segment(from, count);
    const Eigen::LLT<MatrixXd> v(noise_in(e).sum());
    weight_[e].inverse = v.solve(MatrixXd::Identity(count, count));
    weight_[e].design = weight_[e].inverse * a;
    matrix_ += a.transpose() * weight_[e].design;
    right_ += weight_[e].design.transpose() * y;
    squares_ += y.dot(weight_[e].inverse * y);
    log_determinants_ += 2 * v.matrixLLT().diagonal().array().log().sum();
  }

  void add_ridge() {
    for (Index c = 1; c < matrix_.cols(); ++c) {
      const double precision = precision_of(c);
      matrix_(c, c) += precision;
      log_determinants_ -= std::log(precision);
    }
  }

  // Adds d criterion = (trace(P dV) - r'W dV W r)/2 with r = y - A b and P = W - W A (...)^-1 A'W.
  void add_gradient(std::size_t e, std::span<double> out) const {
    const auto [from, count] = bins_of(e);
    const MatrixXd half = factor_.matrixL().solve(weighted(e).transpose());
    const VectorXd r =
        weight_[e].inverse * (problem_.ln_mu.segment(from, count) -
                              problem_.design.middleRows(from, count) * coefficients_);
    const MatrixXd towards = weight_[e].inverse - half.transpose() * half - r * r.transpose();
    const ExperimentNoise noise = noise_in(e);
    const auto parts = noise.parts();
    for (std::size_t k = 0; k < noise_logs; ++k)
      out[k] += (k == 3 ? 0.5 : 1.0) * towards.cwiseProduct(*parts.at(k)).sum();
  }

  const PolynomialProblem& problem_;
  std::span<const double> logs_;
  PolynomialNoise noise_;
  VectorXd relative_rows_;
  MatrixXd matrix_; // A'WA + T^-1
  VectorXd right_;  // A'W y
  std::vector<Weight> weight_;
  double log_determinants_ = 0, squares_ = 0;
  Eigen::LLT<MatrixXd> factor_;
  VectorXd coefficients_;
};

std::vector<double> best_logs(const PolynomialProblem& problem, std::size_t& evaluations) {
  std::vector<double> logs = usual_logs(problem), low, high;
  for (std::size_t k = 0; k < logs.size(); ++k) {
    low.push_back(bounds_of(k).low);
    high.push_back(bounds_of(k).high);
  }
  struct Context {
    const PolynomialProblem& problem;
    std::size_t& evaluations;
  } context{problem, evaluations};
  nlopt::opt search(nlopt::LD_SLSQP, static_cast<unsigned>(logs.size()));
  search.set_lower_bounds(low);
  search.set_upper_bounds(high);
  search.set_maxeval(80);
  search.set_ftol_abs(1e-4); // of a log likelihood
  search.set_min_objective(
      [](const std::vector<double>& x, std::vector<double>& gradient, void* data) {
        auto& c = *static_cast<Context*>(data);
        ++c.evaluations;
        return polynomial_criterion(c.problem, x, gradient);
      },
      &context);
  double least = 0;
  try {
    search.optimize(logs, least);
  } catch (const std::runtime_error&) { // no further improvement; logs are the best so far
  }
  return logs;
}

} // namespace

double polynomial_criterion(const PolynomialProblem& problem, std::span<const double> logs,
                            std::span<double> gradient) {
  const RidgeSolution solution(problem, logs);
  double criterion = solution.criterion();
  if (!gradient.empty()) solution.gradient(gradient);
  const std::vector<double> usual = usual_logs(problem);
  for (std::size_t k = 0; k < logs.size(); ++k) {
    const double away = (logs[k] - usual[k]) / prior_width;
    criterion += away * away / 2;
    if (!gradient.empty()) gradient[k] += away / prior_width;
  }
  return criterion;
}

PolynomialFit fit_polynomial(const PolynomialProblem& problem) {
  PolynomialFit fit;
  const std::vector<double> logs = best_logs(problem, fit.evaluations);
  const RidgeSolution solution(problem, logs);
  fit.coefficients = solution.coefficients();
  fit.criterion = polynomial_criterion(problem, logs);
  fit.noise = noise_of(logs);
  for (std::size_t k = noise_logs; k < logs.size(); ++k)
    fit.spread.push_back(std::exp(logs[k]));
  const std::size_t experiments = problem.first.size() - 1;
  fit.without.resize(fit.coefficients.size(), static_cast<Index>(experiments));
  for (std::size_t e = 0; e < experiments; ++e)
    fit.without.col(static_cast<Index>(e)) = solution.without(e);
  return fit;
}

VectorXd jackknife_errors(const PolynomialFit& fit) {
  const auto experiments = static_cast<double>(fit.without.cols());
  if (fit.without.cols() < 3) return VectorXd::Constant(fit.coefficients.size(), no_value);
  const VectorXd mean = fit.without.rowwise().mean();
  return ((fit.without.colwise() - mean).rowwise().squaredNorm() * (experiments - 1) / experiments)
      .cwiseSqrt();
}

} // namespace frictab::calibrate
