// The loop of levenberg_marquardt.h, and the step within bounds.
#include "stats/levenberg_marquardt.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>

namespace frictab::stats {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double to_step_scale(const ParameterRange& range, double value) {
  return range.by_logarithm ? std::log(value) : value;
}
double from_step_scale(const ParameterRange& range, double moved) {
  return std::clamp(range.by_logarithm ? std::exp(moved) : moved, range.lower, range.upper);
}

// Solves damped and scaled normal equations; independent of the parameters' units.
VectorXd solve_damped(const NormalEquations& n, const std::vector<Index>& free,
                      const VectorXd& descent, const VectorXd& damping) {
  const Index size = free.size();
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

constexpr double least_damping = 1e-12; // as good as none

// Factor of the damping after a step that gained `ratio` times what the quadratic promised.
double fall_by_gain(double ratio) {
  if (ratio > 0.9) return 0.01;
  if (ratio > 0.5) return 0.2;
  return ratio > 0.1 ? 1 : 3;
}

// A step, and what is known where it ends.
struct Trial {
  std::vector<double> to;
  double promised = 0;   // gain by the quadratic
  NormalEquations there; // after a cost alone, without the rest
  bool has_derivatives() const { return there.descent.size() > 0; }
};

class Solver {
public:
  Solver(LeastSquares& problem, std::span<const ParameterRange> ranges, std::vector<double> start,
         const LevenbergMarquardtOptions& options)
      : problem_(problem), ranges_(ranges), options_(options), x_(std::move(start)),
        here_(linearised(x_)), damping_(options.first_damping),
        correction_(options.correction && options.correction->size() == here_.hessian.size()
                        ? *options.correction
                        : MatrixXd::Zero(here_.hessian.rows(), here_.hessian.cols())),
        unit_(here_.hessian.diagonal()) {}

  LevenbergMarquardtFit run() {
    const FitEnding ending = iterate();
    const bool influence =
        here_.descent.size() == 0 || (here_.hessian.diagonal().array() > 0).any();
    return {std::move(x_), here_.cost, ending, std::move(correction_), influence};
  }

private:
  FitEnding iterate() {
    if (!std::isfinite(here_.cost)) return FitEnding::not_finite;
    int small_gains = 0;
    for (std::size_t step = 0; step < options_.most_steps; ++step) {
      if (here_.descent.size() == 0) here_ = linearised(x_);
      const std::vector<Index> free = free_parameters();
      if (free.empty()) return FitEnding::nothing_free;
      if (here_.cost <= options_.exact_cost) return FitEnding::exact;
      const NormalEquations model = corrected(free);
      const double promised = promise(model, free);
      if (options_.promise_ends && std::abs(promised) <= options_.tolerance * here_.cost)
        return FitEnding::no_promise;
      std::optional<Trial> accepted = first_better(model, free);
      if (!accepted)
        return trials_ < options_.most_trials ? FitEnding::no_better_step : FitEnding::most_trials;
      const double before = here_.cost;
      if (options_.learns_curvature) {
        if (!accepted->has_derivatives()) accepted->there = linearised(accepted->to);
        if (promised < 1e-3 * before) learn(accepted->to, accepted->there);
      }
      x_ = std::move(accepted->to);
      here_ = std::move(accepted->there);
      if (options_.goes_on && !options_.goes_on(x_)) return FitEnding::observer;
      small_gains = before - here_.cost <= options_.tolerance * before ? small_gains + 1 : 0;
      if (small_gains >= options_.small_gains_end) return FitEnding::small_gains;
    }
    return FitEnding::most_steps;
  }

  // Normal equations in the step's scale.
  NormalEquations linearised(const std::vector<double>& x) const {
    NormalEquations n = problem_.normal_equations(x);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (ranges_[i].by_logarithm) {
        const Index at = i;
        n.descent(at) *= x[i];
        n.hessian.row(at) *= x[i];
        n.hessian.col(at) *= x[i];
      }
    return n;
  }

  // Parameters that may move: all except those without influence, and those at a bound against
  // which the descent pushes them.
  std::vector<Index> free_parameters() const {
    std::vector<Index> free;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      const Index at = i;
      const bool low = x_[i] <= ranges_[i].lower && here_.descent(at) < 0;
      const bool high = x_[i] >= ranges_[i].upper && here_.descent(at) > 0;
      if (!low && !high && here_.hessian(at, at) > 0) free.push_back(at);
    }
    return free;
  }

  // Adds the correction to the normal equations if they keep a minimum to step to.
  NormalEquations corrected(const std::vector<Index>& free) {
    NormalEquations model = here_;
    if (!options_.learns_curvature) return model;
    const Index size = free.size();
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

  // Gain of the undamped step. (A negative one comes from bounds that bend the step uphill; damping
  // straightens it.)
  double promise(const NormalEquations& model, const std::vector<Index>& free) const {
    if (!options_.promise_ends && !options_.learns_curvature) return 0;
    return step_within_bounds(model, free, least_damping * model.hessian.diagonal()).promised;
  }

  // Increases damping until a step lowers the cost; none if no step does.
  std::optional<Trial> first_better(const NormalEquations& model, const std::vector<Index>& free) {
    const VectorXd diagonal = here_.hessian.diagonal();
    unit_ = options_.unit == DampingUnit::current_diagonal ? diagonal : unit_.cwiseMax(diagonal);
    double growth = options_.growth;
    for (bool first = true; damping_ <= options_.most_damping && trials_ < options_.most_trials;
         first = false) {
      ++trials_;
      Trial trial = step_within_bounds(model, free, damping_ * unit_);
      trial.there = evaluated(trial, first && options_.derivatives_at_first_trial);
      if (trial.there.cost < here_.cost) {
        const double ratio = (here_.cost - trial.there.cost) / trial.promised;
        const double fall = options_.fall > 0 ? options_.fall : fall_by_gain(ratio);
        damping_ = std::max(damping_ * fall, least_damping);
        return trial;
      }
      damping_ = std::max(damping_ * growth, options_.least_damping_after_rejection);
      growth *= options_.growth_of_growth;
    }
    return std::nullopt;
  }

  // The cost where a trial ends, and the rest if requested; infinite if the quadratic itself
  // rises.
  NormalEquations evaluated(const Trial& trial, bool with_derivatives) {
    if (!(trial.promised > 0)) return {std::numeric_limits<double>::infinity(), {}, {}};
    if (with_derivatives) return linearised(trial.to);
    return {problem_.cost(trial.to), {}, {}};
  }

  // Solves for a step. Fixes a parameter that would cross its bound at the bound, and solves for
  // the others again.
  Trial step_within_bounds(const NormalEquations& model, std::vector<Index> free,
                           const VectorXd& damping) const {
    VectorXd step = VectorXd::Zero(model.descent.size());
    while (!free.empty()) {
      const VectorXd part =
          solve_damped(model, free, model.descent - model.hessian * step, damping);
      std::vector<Index> inside;
      for (std::size_t a = 0; a < free.size(); ++a) {
        const auto i = static_cast<std::size_t>(free[a]);
        const double here = to_step_scale(ranges_[i], x_[i]),
                     low = to_step_scale(ranges_[i], ranges_[i].lower),
                     high = to_step_scale(ranges_[i], ranges_[i].upper);
        const double wanted = here + part(a);
        if (!options_.clamps_at_bounds && (wanted < low || wanted > high))
          step(free[a]) = std::clamp(wanted, low, high) - here;
        else
          inside.push_back(free[a]);
      }
      if (inside.size() == free.size()) {
        for (std::size_t a = 0; a < free.size(); ++a)
          step(free[a]) = part(a);
        break;
      }
      free = std::move(inside);
    }
    Trial trial{x_, step.dot(model.descent) - 0.5 * step.dot(model.hessian * step), {}};
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (const double move = step(i); move != 0)
        trial.to[i] = from_step_scale(ranges_[i], to_step_scale(ranges_[i], x_[i]) + move);
    return trial;
  }

  // Updates the correction by the curvature seen along a step: symmetric rank one, in scaled
  // parameters.
  void learn(const std::vector<double>& to, const NormalEquations& there) {
    const Index size = correction_.rows();
    VectorXd step(size), scale(size);
    for (Index i = 0; i < size; ++i) {
      const auto at = static_cast<std::size_t>(i);
      step(i) = to_step_scale(ranges_[at], to[at]) - to_step_scale(ranges_[at], x_[at]);
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

  LeastSquares& problem_;
  std::span<const ParameterRange> ranges_;
  const LevenbergMarquardtOptions& options_;
  std::vector<double> x_;
  NormalEquations here_; // without derivatives after a step that was accepted by its cost alone
  double damping_;
  MatrixXd correction_;
  VectorXd unit_; // of the damping, per parameter
  std::size_t trials_ = 0;
};

} // namespace

LevenbergMarquardtFit levenberg_marquardt(LeastSquares& problem,
                                          std::span<const ParameterRange> ranges,
                                          std::vector<double> start,
                                          const LevenbergMarquardtOptions& options) {
  return Solver(problem, ranges, std::move(start), options).run();
}

} // namespace frictab::stats
