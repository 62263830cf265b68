// Restricted maximum likelihood for the polynomial, and the fits without single experiments.
#include "calibrate/polynomial_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/no_value.h"
#include "stats/reml.h"

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
  return *std::ranges::max_element(problem.order);
}

std::vector<double> usual_logs(const PolynomialProblem& problem) {
  const PolynomialNoise usual;
  std::vector<double> logs;
  for (const double x : {usual.gain, usual.slope, usual.slow, usual.length, usual.white})
    logs.push_back(std::log(x));
  logs.resize(noise_logs + highest_order(problem), std::log(usual_spread));
  return logs;
}

stats::LogPrior log_prior(const PolynomialProblem& problem) {
  return {usual_logs(problem), 1 / (prior_width * prior_width)};
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
  // By gain, slope, slow, length and white.
  std::array<MatrixXd, noise_logs> derivatives() const {
    return {2 * gain, 2 * slope, 2 * slow, by_length, 2 * white};
  }
};

PolynomialNoise noise_of(std::span<const double> logs) {
  return {std::exp(logs[0]), std::exp(logs[1]), std::exp(logs[2]), std::exp(logs[3]),
          std::exp(logs[4])};
}

// The restricted likelihood at one set of standard deviations, without the prior.
class PolynomialLikelihood {
public:
  PolynomialLikelihood(const PolynomialProblem& problem, std::span<const double> logs)
      : problem_(problem), noise_(noise_of(logs)), relative_rows_(relative_rows(problem)),
        reml_(
            {problem.design, problem.ln_mu, problem.first},
            [this](std::size_t e) { return noise_in(e).sum(); }, precision(problem, logs)) {}

  const stats::DenseReml& reml() const { return reml_; }

  void gradient(std::span<double> out) const {
    std::ranges::fill(out, 0.0);
    for (std::size_t e = 0; e + 1 < problem_.first.size(); ++e) {
      const MatrixXd slope = reml_.slope(e);
      const auto derivatives = noise_in(e).derivatives();
      for (std::size_t k = 0; k < noise_logs; ++k)
        out[k] += slope.cwiseProduct(derivatives.at(k)).sum();
    }
    const VectorXd ridge = reml_.ridge_slopes();
    for (Index c = 1; c < ridge.size(); ++c)
      out[noise_logs + problem_.order[static_cast<std::size_t>(c)] - 1] += ridge(c);
  }

private:
  // Relative to the bins that white refers to.
  static VectorXd relative_rows(const PolynomialProblem& problem) {
    return problem.rows / (problem.rows.size() > 0 ? problem.rows.mean() : 1);
  }

  static VectorXd precision(const PolynomialProblem& problem, std::span<const double> logs) {
    VectorXd precision = VectorXd::Zero(problem.design.cols());
    for (Index c = 1; c < precision.size(); ++c)
      precision(c) =
          std::exp(-2 * logs[noise_logs + problem.order[static_cast<std::size_t>(c)] - 1]);
    return precision;
  }

  ExperimentNoise noise_in(std::size_t e) const {
    const Index from = problem_.first[e], count = problem_.first[e + 1] - from;
    return {noise_, problem_.position.segment(from, count), relative_rows_.segment(from, count)};
  }

  const PolynomialProblem& problem_;
  PolynomialNoise noise_;
  VectorXd relative_rows_;
  stats::DenseReml reml_;
};

double criterion_without_prior(const PolynomialProblem& problem, std::span<const double> logs,
                               std::span<double> gradient) {
  const PolynomialLikelihood likelihood(problem, logs);
  if (!gradient.empty()) likelihood.gradient(gradient);
  return likelihood.reml().criterion();
}

stats::LogMinimum best_logs(const PolynomialProblem& problem) {
  const std::vector<double> usual = usual_logs(problem);
  stats::LogSearch search{.low = std::vector<double>(usual.size(), std::log(1e-4)),
                          .high = std::vector<double>(usual.size(), std::log(3.0)),
                          .prior = log_prior(problem),
                          .has_gradient = true,
                          .tolerance = 1e-4, // of a log likelihood
                          .most_evaluations = 80};
  // Upper bound of about a third of the stroke: a slower part could not be distinguished from the
  // gain and would absorb it.
  search.low[3] = std::log(0.02);
  search.high[3] = std::log(0.4);
  return stats::least_criterion(
      [&](std::span<const double> logs, std::span<double> gradient) {
        return criterion_without_prior(problem, logs, gradient);
      },
      usual, search);
}

} // namespace

double polynomial_criterion(const PolynomialProblem& problem, std::span<const double> logs,
                            std::span<double> gradient) {
  return criterion_without_prior(problem, logs, gradient) + log_prior(problem)(logs, gradient);
}

PolynomialFit fit_polynomial(const PolynomialProblem& problem) {
  const stats::LogMinimum best = best_logs(problem);
  const PolynomialLikelihood likelihood(problem, best.logs);
  PolynomialFit fit;
  fit.evaluations = best.evaluations;
  fit.coefficients = likelihood.reml().coefficients();
  fit.criterion = best.criterion;
  fit.noise = noise_of(best.logs);
  for (std::size_t k = noise_logs; k < best.logs.size(); ++k)
    fit.spread.push_back(std::exp(best.logs[k]));
  const std::size_t experiments = problem.first.size() - 1;
  fit.without.resize(fit.coefficients.size(), experiments);
  for (std::size_t e = 0; e < experiments; ++e)
    fit.without.col(e) = likelihood.reml().without(e);
  return fit;
}

MatrixXd bin_covariance(const PolynomialNoise& noise, const VectorXd& position,
                        const VectorXd& relative_rows) {
  return ExperimentNoise(noise, position, relative_rows).sum();
}

VectorXd jackknife_errors(const PolynomialFit& fit) {
  const auto experiments = static_cast<double>(fit.without.cols());
  if (fit.without.cols() < 3) return VectorXd::Constant(fit.coefficients.size(), no_value);
  const VectorXd mean = fit.without.rowwise().mean();
  return ((fit.without.colwise() - mean).rowwise().squaredNorm() * (experiments - 1) / experiments)
      .cwiseSqrt();
}

} // namespace frictab::calibrate
