// Levenberg-Marquardt for one net with generalised least squares by experiment.
#include "calibrate/network_fit.h"

#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

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
  for (auto member :
       {&NetworkBins::stress, &NetworkBins::limit, &NetworkBins::measured, &NetworkBins::weight})
    (part.*member).resize(size);
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    const Index from = first[chosen[c]], count = first[chosen[c] + 1] - from;
    part.z.middleRows(part.first[c], count) = z.middleRows(from, count);
    for (auto member :
         {&NetworkBins::stress, &NetworkBins::limit, &NetworkBins::measured, &NetworkBins::weight})
      (part.*member).segment(part.first[c], count) = (this->*member).segment(from, count);
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
  const Index inputs = static_cast<Index>(shape.inputs), hidden = static_cast<Index>(shape.hidden);
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
  direction.reach.resize(static_cast<Index>(bins.experiments()));
  for (std::size_t e = 0; e < bins.experiments(); ++e) {
    auto part = direction.unit.segment(bins.first[e], bins.first[e + 1] - bins.first[e]);
    const double length = part.norm();
    direction.reach(static_cast<Index>(e)) = length;
    if (length > 0) part /= length;
  }
  return direction;
}

namespace {

// Loss of one net: half of r' V^-1 r, with V from the scatter, plus half the decay of w'w.
class NetworkLoss {
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

  double operator()(const VectorXd& weights) const {
    const VectorXd r =
        scaled_residual(network_tau(problem_.training, problem_.shape, problem_.mu0, weights));
    const VectorXd along = along_gain(r);
    return 0.5 * (r.squaredNorm() - along.dot(share_.cwiseProduct(along)) +
                  weights.dot(decay_.cwiseProduct(weights)));
  }

  // Computes the Gauss-Newton curvature and the descent (minus the gradient); returns the loss.
  double linearise(const VectorXd& weights, MatrixXd& curvature, VectorXd& descent) const {
    MatrixXd j;
    const VectorXd tau = network_tau(problem_.training, problem_.shape, problem_.mu0, weights, &j);
    j.array().colwise() *= problem_.training.weight.array() / problem_.scatter.noise_MPa;
    const VectorXd r = scaled_residual(tau);
    const MatrixXd j_along = along_gain(j);
    const VectorXd r_along = share_.cwiseProduct(along_gain(r));
    curvature.setZero(j.cols(), j.cols());
    curvature.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose());
    curvature.selfadjointView<Eigen::Lower>().rankUpdate(
        (share_.cwiseSqrt().asDiagonal() * j_along).transpose(), -1.0);
    curvature.diagonal() += decay_;
    descent = j.transpose() * r - j_along.transpose() * r_along - decay_.cwiseProduct(weights);
    return 0.5 * (r.squaredNorm() - along_gain(r).dot(r_along) +
                  weights.dot(decay_.cwiseProduct(weights)));
  }

private:
  VectorXd scaled_residual(const VectorXd& tau) const {
    return network_residual(problem_.training, tau) / problem_.scatter.noise_MPa;
  }

  template <class Rows> Rows along_gain(const Rows& rows) const {
    const auto& first = problem_.training.first;
    Rows along(static_cast<Index>(first.size()) - 1, rows.cols());
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
  constexpr std::size_t max_iterations = 30, patience = 5;
  constexpr double smallest_gain = 1e-4; // relative; the remaining gain is far below the scatter
  const NetworkLoss loss(problem);
  NetworkFit fit{start, std::move(start), std::numeric_limits<double>::infinity(), 0};
  VectorXd& w = fit.last;
  double damping = 1e-2;
  std::size_t since_best = 0;
  MatrixXd curvature;
  VectorXd descent;
  while (fit.iterations < max_iterations && since_best < patience) {
    const double cost = loss.linearise(w, curvature, descent);
    double next_cost = cost;
    for (int attempt = 0; attempt < 10 && !(next_cost < cost); ++attempt) {
      MatrixXd damped = curvature;
      damped.diagonal() += damping * curvature.diagonal();
      const VectorXd next = w + damped.selfadjointView<Eigen::Lower>().ldlt().solve(descent);
      next_cost = loss(next);
      if (next_cost < cost)
        w = next;
      else
        damping *= 5;
    }
    if (!(next_cost < cost)) break;
    damping = std::max(damping / 5, 1e-9);
    ++fit.iterations;
    ++since_best;
    if (const double square = held_out_square(problem, w); square < fit.held_out_square) {
      fit.held_out_square = square;
      fit.weights = w;
      since_best = 0;
    }
    if (cost - next_cost < smallest_gain * cost) break;
  }
  if (fit.iterations == 0) fit.held_out_square = held_out_square(problem, w);
  return fit;
}

} // namespace frictab::calibrate
