// Generalised least squares by experiment for one net, as a problem of Levenberg-Marquardt.
#include "calibrate/network_fit.h"

#include <cmath>
#include <limits>

#include "stats/levenberg_marquardt.h"

namespace frictab::calibrate {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

NetworkBins NetworkBins::of(std::span<const std::size_t> chosen) const {
  NetworkBins part;
  part.first = {0};
  for (const std::size_t e : chosen)
    part.first.push_back(part.first.back() + first[e + 1] - first[e]);
  const Index size = part.first.back();
  part.z.resize(size, z.cols());
  const auto columns = {&NetworkBins::stress, &NetworkBins::limit, &NetworkBins::measured,
                        &NetworkBins::weight};
  for (const auto column : columns)
    (part.*column).resize(size);
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const Index from = first[chosen[c]], count = first[chosen[c] + 1] - from;
    part.z.middleRows(part.first[c], count) = z.middleRows(from, count);
    for (const auto column : columns)
      (part.*column).segment(part.first[c], count) = (this->*column).segment(from, count);
  }
  return part;
}

namespace {

// tanh(a + bias) by the exponential, which Eigen vectorises, whereas it calls libm for tanh;
// accurate to a few units of 1e-16, and correct where the exponential overflows.
template <class Vector> VectorXd tanh_of(const Vector& a, double bias) {
  return 1 - 2 / ((2 * (a.array() + bias)).exp() + 1);
}

} // namespace

VectorXd network_tau(const NetworkBins& bins, const NetworkShape& shape, double mu0,
                     const VectorXd& weights, MatrixXd* derivative) {
  const Index inputs = shape.inputs, hidden = shape.hidden;
  const Index per_unit = inputs + 2;
  MatrixXd activation(bins.z.rows(), hidden);
  VectorXd output = VectorXd::Constant(bins.z.rows(), weights(weights.size() - 1));
  for (Index h = 0; h < hidden; ++h) {
    const Index at = h * per_unit;
    activation.col(h) = tanh_of(bins.z * weights.segment(at, inputs), weights(at + inputs));
    output += weights(at + inputs + 1) * activation.col(h);
  }
  const VectorXd free = mu0 * output.array().exp() * bins.stress.array();
  if (derivative) {
    derivative->resize(bins.z.rows(), shape.weights());
    const VectorXd slope = (free.array() < bins.limit.array()).select(free, 0.0);
    for (Index h = 0; h < hidden; ++h) {
      const Index at = h * per_unit;
      const auto a = activation.col(h).array();
      derivative->col(at + inputs + 1) = slope.array() * a;
      derivative->col(at + inputs) = slope.array() * weights(at + inputs + 1) * (1 - a * a);
      for (Index i = 0; i < inputs; ++i)
        derivative->col(at + i) = derivative->col(at + inputs).cwiseProduct(bins.z.col(i));
    }
    derivative->col(derivative->cols() - 1) = slope;
  }
  return free.cwiseMin(bins.limit);
}

VectorXd network_residual(const NetworkBins& bins, const VectorXd& tau) {
  return bins.weight.cwiseProduct(bins.measured - tau);
}

GainDirection gain_direction(const NetworkBins& bins, double mu0) {
  GainDirection direction;
  direction.unit = mu0 * bins.weight.cwiseProduct(bins.stress);
  direction.reach.resize(bins.experiments());
  for (std::size_t e = 0; e < bins.experiments(); ++e) {
    auto part = direction.unit.segment(bins.first[e], bins.first[e + 1] - bins.first[e]);
    const double length = part.norm();
    direction.reach(e) = length;
    if (length > 0) part /= length;
  }
  return direction;
}

namespace {

// Loss of one net: half of r' V^-1 r, with V from the scatter, plus half the decay of w'w.
class NetworkLoss : public stats::LeastSquares {
public:
  explicit NetworkLoss(const NetworkProblem& problem)
      : problem_(problem), direction_(gain_direction(problem.training, problem.mu0)),
        decay_(VectorXd::Constant(problem.shape.weights(), problem.decay)) {
    decay_(decay_.size() - 1) = 0;
    // V^-1 = (1 - share u u')/noise^2 for each experiment (Sherman and Morrison 1950).
    const auto ratio =
        (problem.scatter.gain / problem.scatter.noise_MPa * direction_.reach).array();
    share_ = ratio.square() / (1 + ratio.square());
  }

  double cost(std::span<const double> parameters) override {
    const VectorXd weights = stats::as_vector(parameters);
    const VectorXd r =
        scaled_residual(network_tau(problem_.training, problem_.shape, problem_.mu0, weights));
    return cost_of(r, along_gain(r), weights);
  }

  stats::NormalEquations normal_equations(std::span<const double> parameters) override {
    const VectorXd weights = stats::as_vector(parameters);
    MatrixXd j;
    const VectorXd tau = network_tau(problem_.training, problem_.shape, problem_.mu0, weights, &j);
    j.array().colwise() *= problem_.training.weight.array() / problem_.scatter.noise_MPa;
    const VectorXd r = scaled_residual(tau), r_along = along_gain(r);
    const MatrixXd j_along = along_gain(j);
    MatrixXd curvature = MatrixXd::Zero(j.cols(), j.cols());
    curvature.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose());
    curvature.selfadjointView<Eigen::Lower>().rankUpdate(
        (share_.cwiseSqrt().asDiagonal() * j_along).transpose(), -1.0);
    curvature.diagonal() += decay_;
    return {cost_of(r, r_along, weights),
            j.transpose() * r - j_along.transpose() * share_.cwiseProduct(r_along) -
                decay_.cwiseProduct(weights),
            curvature.selfadjointView<Eigen::Lower>()};
  }

private:
  double cost_of(const VectorXd& r, const VectorXd& r_along, const VectorXd& weights) const {
    return 0.5 * (r.squaredNorm() - r_along.dot(share_.cwiseProduct(r_along)) +
                  weights.dot(decay_.cwiseProduct(weights)));
  }

  VectorXd scaled_residual(const VectorXd& tau) const {
    return network_residual(problem_.training, tau) / problem_.scatter.noise_MPa;
  }

  template <class Rows> Rows along_gain(const Rows& rows) const {
    const auto& first = problem_.training.first;
    Rows along(first.size() - 1, rows.cols());
    for (Index e = 0; e < along.rows(); ++e) {
      const Index at = first[static_cast<std::size_t>(e)];
      const Index count = first[static_cast<std::size_t>(e) + 1] - at;
      along.row(e) = direction_.unit.segment(at, count).transpose() * rows.middleRows(at, count);
    }
    return along;
  }

  const NetworkProblem& problem_;
  GainDirection direction_;
  VectorXd decay_;
  VectorXd share_; // per experiment
};

double held_out_square(const NetworkProblem& problem, const VectorXd& weights) {
  const VectorXd tau = network_tau(problem.held_out, problem.shape, problem.mu0, weights);
  return network_residual(problem.held_out, tau).squaredNorm() /
         static_cast<double>(problem.held_out.weight.size());
}

} // namespace

NetworkFit fit_network(const NetworkProblem& problem, VectorXd start) {
  constexpr std::size_t patience = 5;
  NetworkFit fit{start, {}, std::numeric_limits<double>::infinity(), 0};
  std::size_t since_best = 0;
  const auto improves_held_out = [&](std::span<const double> weights) {
    ++fit.iterations;
    ++since_best;
    if (const double square = held_out_square(problem, stats::as_vector(weights));
        square < fit.held_out_square) {
      fit.held_out_square = square;
      fit.weights = stats::as_vector(weights);
      since_best = 0;
    }
    return since_best < patience;
  };
  const stats::LevenbergMarquardtOptions options{
      .tolerance = 1e-4, // the remaining gain is far below the scatter
      .promise_ends = false,
      .small_gains_end = 1,
      .most_steps = 30,
      .goes_on = improves_held_out,
      .first_damping = 1e-2,
      .unit = stats::DampingUnit::current_diagonal,
      .fall = 0.2,
      .growth = 5,
      .growth_of_growth = 1,
      .derivatives_at_first_trial = false,
      .learns_curvature = false};
  NetworkLoss loss(problem);
  const std::vector<stats::ParameterRange> unbounded(static_cast<std::size_t>(start.size()));
  const stats::LevenbergMarquardtFit last = stats::levenberg_marquardt(
      loss, unbounded, {start.data(), start.data() + start.size()}, options);
  fit.last = stats::as_vector(last.parameters);
  if (fit.iterations == 0) fit.held_out_square = held_out_square(problem, fit.last);
  return fit;
}

} // namespace frictab::calibrate
