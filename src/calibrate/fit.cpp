// Levenberg-Marquardt with bounds.
#include "calibrate/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "calibrate/normal_equations.h"

namespace frictab::calibrate {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Quantity moved by a step: the parameter, or its logarithm if its bounds identify it as a positive
// scale of unknown size. In C p^a the scale C and the exponent a trade off against each other along
// a curved valley; in ln C the valley is straight, so that a step can follow it.
double to_step_scale(const models::Parameter& p, double value) {
  return is_scale(p) ? std::log(value) : value;
}
double from_step_scale(const models::Parameter& p, double moved) {
  return std::clamp(is_scale(p) ? std::exp(moved) : moved, p.lower, p.upper);
}

// Parameters that may move: all except those without influence, and those at a bound against which
// the descent pushes them.
std::vector<Index> free_parameters(const FitProblem& problem, const NormalEquations& n,
                                   const std::vector<double>& x) {
  std::vector<Index> free;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto at = static_cast<Index>(i);
    const bool low = x[i] <= problem.parameters[i].lower && n.descent(at) < 0;
    const bool high = x[i] >= problem.parameters[i].upper && n.descent(at) > 0;
    if (!low && !high && n.hessian(at, at) > 0) free.push_back(at);
  }
  return free;
}

// Solves damped and scaled normal equations; independent of the parameters' units.
VectorXd solve_damped(const NormalEquations& n, const std::vector<Index>& free,
                      const VectorXd& descent, const VectorXd& damping) {
  const auto size = static_cast<Index>(free.size());
  MatrixXd h(size, size);
  VectorXd g(size), scale(size);
  for (Index a = 0; a < size; ++a)
    scale(a) = 1 / std::sqrt(n.hessian(free[a], free[a]));
  for (Index a = 0; a < size; ++a) {
    g(a) = descent(free[a]) * scale(a);
    for (Index b = 0; b < size; ++b)
      h(a, b) = n.hessian(free[a], free[b]) * scale(a) * scale(b);
    h(a, a) += damping(free[a]) * scale(a) * scale(a);
  }
  return h.ldlt().solve(g).cwiseProduct(scale);
}

struct Step {
  std::vector<double> to;
  double predicted = 0; // reduction of the cost by the quadratic model
};

// Fixes a parameter that would leave its bounds at the bound, and solves for the others again.
Step bounded_step(const FitProblem& problem, const NormalEquations& n, std::vector<Index> free,
                  const std::vector<double>& x, const VectorXd& damping) {
  VectorXd step = VectorXd::Zero(n.descent.size());
  while (!free.empty()) {
    const VectorXd part = solve_damped(n, free, n.descent - n.hessian * step, damping);
    std::vector<Index> inside;
    for (std::size_t a = 0; a < free.size(); ++a) {
      const auto i = static_cast<std::size_t>(free[a]);
      const models::Parameter& p = problem.parameters[i];
      const double here = to_step_scale(p, x[i]), low = to_step_scale(p, p.lower),
                   high = to_step_scale(p, p.upper);
      const double wanted = here + part(static_cast<Index>(a));
      if (wanted < low || wanted > high)
        step(free[a]) = std::clamp(wanted, low, high) - here;
      else
        inside.push_back(free[a]);
    }
    if (inside.size() == free.size()) {
      for (std::size_t a = 0; a < free.size(); ++a)
        step(free[a]) = part(static_cast<Index>(a));
      break;
    }
    free = std::move(inside);
  }
  Step result{x, step.dot(n.descent) - 0.5 * step.dot(n.hessian * step)};
  for (std::size_t i = 0; i < x.size(); ++i) {
    const models::Parameter& p = problem.parameters[i];
    const double move = step(static_cast<Index>(i));
    if (move != 0) result.to[i] = from_step_scale(p, to_step_scale(p, x[i]) + move);
  }
  return result;
}

double mean_square(std::span<const double> values) {
  double sum = 0;
  for (const double v : values)
    sum += v * v;
  return sum / static_cast<double>(values.size());
}

// Factor of the damping after a step whose gain was `ratio` times the prediction of the quadratic
// model.
double damping_change(double ratio) {
  if (ratio > 0.9) return 0.01;
  if (ratio > 0.5) return 0.2;
  return ratio > 0.1 ? 1 : 3;
}

// State of a fit: its parameters, the normal equations there, and the damping of the next step.
class Solver {
public:
  Solver(const FitProblem& problem, const LossFunction& loss, std::vector<double> start,
         const FitOptions& options)
      : problem_(problem), loss_(loss), options_(options), x_(std::move(start)),
        here_(evaluate(x_)), damping_(options.damping),
        exact_(1e-26 * mean_square(problem.measured)),
        correction_(options.correction && options.correction->size() == here_.hessian.size()
                        ? *options.correction
                        : MatrixXd::Zero(here_.hessian.rows(), here_.hessian.cols())),
        largest_(here_.hessian.diagonal()) {}

  FitResult run() {
    std::string why = fmt::format("stopped: {} iterations", options_.iterations);
    if (!std::isfinite(here_.cost)) why = "stopped: the law is not finite at the start";
    for (std::size_t i = 0; std::isfinite(here_.cost) && i < options_.iterations; ++i)
      if (const char* end = iterate()) {
        why = end;
        break;
      }
    const bool influence = (here_.hessian.diagonal().array() > 0).any();
    return {x_, here_.cost, evaluations_, why, correction_, !influence};
  }

private:
  double cost(const std::vector<double>& x) {
    ++evaluations_;
    return mean_cost(problem_, loss_, x);
  }

  NormalEquations evaluate(const std::vector<double>& x) {
    ++evaluations_;
    NormalEquations n = normal_equations(problem_, loss_, x);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (is_scale(problem_.parameters[i])) {
        const auto at = static_cast<Index>(i);
        n.descent(at) *= x[i];
        n.hessian.row(at) *= x[i];
        n.hessian.col(at) *= x[i];
      }
    return n;
  }

  // Makes one step; returns the reason if the fit has ended, else nullptr.
  const char* iterate() {
    const auto free = free_parameters(problem_, here_, x_);
    if (free.empty()) return "converged: every parameter is held by a bound or without influence";
    if (here_.cost <= exact_) return "converged: the law passes through every row";
    constexpr double undamped = 1e-12;
    model_ = corrected(free);
    largest_ = largest_.cwiseMax(here_.hessian.diagonal());
    const Step best =
        bounded_step(problem_, model_, free, x_, undamped * model_.hessian.diagonal());
    // (A negative prediction comes from bounds that bend the step uphill; damping straightens it.)
    if (std::abs(best.predicted) <= options_.tolerance * here_.cost)
      return "converged: no step promises a gain";
    const double before = here_.cost;
    close_ = best.predicted < 1e-3 * before;
    if (!descend(free)) return "converged: no step improves the fit";
    // Near a kink of the law the prediction stays wrong, so three negligible gains end the fit too.
    small_gains_ = before - here_.cost <= options_.tolerance * before ? small_gains_ + 1 : 0;
    return small_gains_ >= 3 ? "converged: the gains have become negligible" : nullptr;
  }

  // Adds the correction to the normal equations if they keep a minimum to step to.
  NormalEquations corrected(const std::vector<Index>& free) {
    NormalEquations model = here_;
    const auto size = static_cast<Index>(free.size());
    MatrixXd h(size, size);
    for (Index a = 0; a < size; ++a)
      for (Index b = 0; b < size; ++b)
        h(a, b) = (here_.hessian(free[a], free[b]) + correction_(free[a], free[b])) /
                  std::sqrt(here_.hessian(free[a], free[a]) * here_.hessian(free[b], free[b]));
    if (Eigen::LLT<MatrixXd>(h - 1e-9 * MatrixXd::Identity(size, size)).info() == Eigen::Success)
      model.hessian += correction_;
    else
      correction_.setZero();
    return model;
  }

  // Updates the correction by the curvature seen along the step: symmetric rank one, in scaled
  // parameters.
  void learn(const std::vector<double>& to, const NormalEquations& there) {
    const Index size = correction_.rows();
    VectorXd step(size), scale(size);
    for (Index i = 0; i < size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const models::Parameter& p = problem_.parameters[at];
      step(i) = to_step_scale(p, to[at]) - to_step_scale(p, x_[at]);
      scale(i) = there.hessian(i, i) > 0 ? std::sqrt(there.hessian(i, i)) : 1;
    }
    const VectorXd missed = here_.descent - there.descent - (there.hessian + correction_) * step;
    const double along = missed.dot(step);
    const double size_of_missed = missed.cwiseQuotient(scale).norm();
    if (std::abs(along) > 1e-3 * size_of_missed * step.cwiseProduct(scale).norm())
      correction_ += missed * missed.transpose() / along;
    // A correction larger than the curvature itself comes from a crossed kink and is discarded.
    const MatrixXd relative =
        scale.cwiseInverse().asDiagonal() * correction_ * scale.cwiseInverse().asDiagonal();
    if (!(relative.norm() < 3)) correction_.setZero();
  }

  bool descend(const std::vector<Index>& free) {
    double growth = 4;
    for (int attempt = 0; attempt < 25; ++attempt) {
      const Step step = bounded_step(problem_, model_, free, x_, damping_ * largest_);
      NormalEquations there{std::numeric_limits<double>::infinity(), {}, {}};
      const bool downhill = step.predicted > 0;
      if (downhill && attempt == 0) // likely to be accepted: value and derivatives in one sweep
        there = evaluate(step.to);
      else if (downhill)
        there.cost = cost(step.to);
      if (there.cost < here_.cost) {
        const double ratio = (here_.cost - there.cost) / step.predicted;
        damping_ = std::max(damping_ * damping_change(ratio), 1e-12);
        if (attempt > 0) there = evaluate(step.to);
        if (close_) learn(step.to, there);
        x_ = step.to;
        here_ = std::move(there);
        return true;
      }
      damping_ = std::max(damping_ * growth, 1e-6);
      growth *= 2;
      if (damping_ > 1e14) return false;
    }
    return false;
  }

  const FitProblem& problem_;
  const LossFunction& loss_;
  const FitOptions& options_;
  std::size_t evaluations_ = 0;
  std::vector<double> x_;
  NormalEquations here_;
  double damping_;
  double exact_; // L2 loss below which only rounding is left
  MatrixXd correction_;
  VectorXd largest_;      // curvature seen by each parameter: unit of the damping (More 1978)
  NormalEquations model_; // here_ with the correction
  bool close_ = false;    // to the minimum, where gradients reveal curvature
  int small_gains_ = 0;
};

} // namespace

FitResult fit_from(const FitProblem& problem, const LossFunction& loss, std::vector<double> start,
                   const FitOptions& options) {
  return Solver(problem, loss, std::move(start), options).run();
}

} // namespace frictab::calibrate
