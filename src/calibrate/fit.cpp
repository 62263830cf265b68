// Levenberg-Marquardt with bounds, and global starts by NLopt.
#include "calibrate/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <nlopt.hpp>

#include "core/random.h"

namespace frictab {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double mean_cost(const FitProblem& problem, const LossFunction& loss,
                 std::span<const double> parameters) {
  double sum = 0;
  problem.law.sweep(parameters, false, [&](const BoundProgram::Block& block) {
    double part = 0;
    for (std::size_t i = 0; i < block.count; ++i)
      part += loss.cost(problem.measured[block.first + i] - block.value[i]);
    sum += part;
  });
  const double mean = sum / static_cast<double>(problem.law.rows());
  return std::isfinite(mean) ? mean : std::numeric_limits<double>::infinity();
}

struct Normal {
  MatrixXd hessian; // mean of w J'J
  VectorXd descent; // mean of w r J: minus the gradient
  double cost = 0;
};

Normal normal_equations(const FitProblem& problem, const LossFunction& loss,
                        std::span<const double> parameters) {
  const auto size = static_cast<Eigen::Index>(parameters.size());
  Normal n{MatrixXd::Zero(size, size), VectorXd::Zero(size), 0};
  std::vector<double> residual(Program::block), weight(Program::block);
  problem.law.sweep(parameters, true, [&](const BoundProgram::Block& block) {
    double part = 0;
    for (std::size_t i = 0; i < block.count; ++i) {
      const double r = problem.measured[block.first + i] - block.value[i];
      residual[i] = r;
      weight[i] = loss.weight(r);
      part += loss.cost(r);
    }
    n.cost += part;
    for (Eigen::Index a = 0; a < size; ++a) {
      const double* ja = block.derivative[static_cast<std::size_t>(a)];
      double d = 0;
      for (std::size_t i = 0; i < block.count; ++i)
        d += weight[i] * residual[i] * ja[i];
      n.descent(a) += d;
      for (Eigen::Index b = 0; b <= a; ++b) {
        const double* jb = block.derivative[static_cast<std::size_t>(b)];
        double h = 0;
        for (std::size_t i = 0; i < block.count; ++i)
          h += weight[i] * ja[i] * jb[i];
        n.hessian(a, b) += h;
      }
    }
  });
  const double rows = static_cast<double>(problem.law.rows());
  n.hessian = n.hessian.selfadjointView<Eigen::Lower>();
  n.hessian /= rows;
  n.descent /= rows;
  n.cost /= rows;
  return n;
}

// Parameters that may move: not those at a bound that the descent pushes them against, nor those
// without any influence.
std::vector<Eigen::Index> free_parameters(const FitProblem& problem, const Normal& n,
                                          const std::vector<double>& x) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const bool low = x[i] <= problem.parameters[i].lower && n.descent(at) < 0;
    const bool high = x[i] >= problem.parameters[i].upper && n.descent(at) > 0;
    if (!low && !high && n.hessian(at, at) > 0) free.push_back(at);
  }
  return free;
}

std::vector<double> damped_step(const FitProblem& problem, const Normal& n,
                                const std::vector<Eigen::Index>& free, const std::vector<double>& x,
                                double damping) {
  const auto size = static_cast<Eigen::Index>(free.size());
  MatrixXd h(size, size);
  VectorXd g(size);
  VectorXd scale(size); // Marquardt's scaling: independent of the parameters' units
  for (Eigen::Index a = 0; a < size; ++a)
    scale(a) = 1 / std::sqrt(n.hessian(free[a], free[a]));
  for (Eigen::Index a = 0; a < size; ++a) {
    g(a) = n.descent(free[a]) * scale(a);
    for (Eigen::Index b = 0; b < size; ++b)
      h(a, b) = n.hessian(free[a], free[b]) * scale(a) * scale(b);
    h(a, a) += damping;
  }
  const VectorXd step = h.ldlt().solve(g);
  std::vector<double> next = x;
  for (Eigen::Index a = 0; a < size; ++a) {
    const auto i = static_cast<std::size_t>(free[a]);
    const Parameter& p = problem.parameters[i];
    next[i] = std::clamp(x[i] + step(a) * scale(a), p.lower, p.upper);
  }
  return next;
}

} // namespace

FitResult fit_from(const FitProblem& problem, const LossFunction& loss, std::vector<double> start) {
  constexpr std::size_t max_iterations = 200;
  constexpr double smallest_gain = 1e-13; // relative; below, rounding decides
  FitResult result{std::move(start), 0, 0, "stopped: 200 iterations"};
  std::vector<double>& x = result.parameters;
  double damping = 1e-3;
  int small_steps = 0;
  for (std::size_t iteration = 0; iteration < max_iterations; ++iteration) {
    const Normal n = normal_equations(problem, loss, x);
    ++result.evaluations;
    result.cost = n.cost;
    if (!std::isfinite(n.cost)) {
      result.termination = "stopped: the law is not finite at the start";
      result.cost = std::numeric_limits<double>::infinity();
      return result;
    }
    const auto free = free_parameters(problem, n, x);
    if (free.empty()) {
      result.termination = "converged: every parameter is held by a bound or without influence";
      return result;
    }
    bool improved = false;
    for (int attempt = 0; attempt < 30 && !improved; ++attempt) {
      const std::vector<double> next = damped_step(problem, n, free, x, damping);
      const double cost = mean_cost(problem, loss, next);
      ++result.evaluations;
      if (cost < n.cost) {
        improved = true;
        small_steps = n.cost - cost <= smallest_gain * n.cost ? small_steps + 1 : 0;
        x = next;
        result.cost = cost;
        damping = std::max(damping / 10, 1e-12);
      } else {
        damping *= 8;
      }
    }
    if (!improved || small_steps >= 2) {
      result.termination =
          improved ? "converged: relative gain below 1e-13" : "converged: no step improves the fit";
      return result;
    }
  }
  return result;
}

namespace {

// The loss with its final smoothing, approached in stages for L1 so that no stage is stiff.
std::vector<LossFunction> stages(Loss loss, double huber_delta_MPa) {
  if (loss != Loss::l1) return {{loss, huber_delta_MPa}};
  return {{Loss::l1, 3.0}, {Loss::l1, 0.1}, {Loss::l1, smallest_rounding_MPa}};
}

std::vector<double> direct_start(const FitProblem& coarse, const LossFunction& loss,
                                 FitResult& total) {
  const std::size_t size = coarse.parameters.size();
  std::vector<double> lower, upper, x;
  for (const Parameter& p : coarse.parameters) {
    lower.push_back(p.lower);
    upper.push_back(p.upper);
    x.push_back(p.start);
  }
  nlopt::opt search(nlopt::GN_DIRECT_L, static_cast<unsigned>(size));
  search.set_lower_bounds(lower);
  search.set_upper_bounds(upper);
  search.set_maxeval(static_cast<int>(120 * size));
  struct Context {
    const FitProblem& problem;
    const LossFunction& loss;
    std::size_t& evaluations;
  } context{coarse, loss, total.evaluations};
  search.set_min_objective(
      [](unsigned n, const double* p, double*, void* data) {
        auto& c = *static_cast<Context*>(data);
        ++c.evaluations;
        const double cost = mean_cost(c.problem, c.loss, {p, n});
        return std::isfinite(cost) ? cost : 1e300;
      },
      &context);
  double best = 0;
  search.optimize(x, best);
  return x;
}

} // namespace

FitResult fit_global(const FitProblem& coarse, const FitProblem& full, Loss loss,
                     double huber_delta_MPa) {
  const auto losses = stages(loss, huber_delta_MPa);
  const std::size_t size = full.parameters.size();
  FitResult total;
  std::vector<std::vector<double>> starts(1);
  for (const Parameter& p : full.parameters)
    starts[0].push_back(p.start);
  starts.push_back(direct_start(coarse, losses.front(), total));
  constexpr std::size_t halton_points = 6;
  std::vector<double> unit(size);
  for (std::size_t i = 0; i < halton_points; ++i) {
    halton(i, unit);
    std::vector<double> start;
    for (std::size_t p = 0; p < size; ++p) {
      const Parameter& parameter = full.parameters[p];
      start.push_back(parameter.lower + unit[p] * (parameter.upper - parameter.lower));
    }
    starts.push_back(start);
  }
  std::vector<FitResult> rough;
  for (const auto& start : starts) {
    rough.push_back(fit_from(coarse, losses.front(), start));
    total.evaluations += rough.back().evaluations;
  }
  std::stable_sort(rough.begin(), rough.end(),
                   [](const FitResult& a, const FitResult& b) { return a.cost < b.cost; });
  // Laws with a kink have several minima; on all rows another one may win.
  FitResult best;
  best.cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rough.size(); ++i) {
    if (i > 0 && rough[i].cost > rough[0].cost * 1.01) break;
    if (i > 0 && rough[i].cost - rough[i - 1].cost <= 1e-9 * rough[i].cost) continue; // the same
    FitResult polished = rough[i];
    for (const LossFunction& stage : losses) {
      polished = fit_from(full, stage, polished.parameters);
      total.evaluations += polished.evaluations;
    }
    if (polished.cost < best.cost) best = polished;
  }
  best.evaluations = total.evaluations;
  return best;
}

} // namespace frictab
