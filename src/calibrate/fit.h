// Bounded nonlinear fit of a formula to measured shear stress.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calibrate/loss.h"
#include "expr/program.h"
#include "models/law.h"

namespace frictab {

// The rows a law is fitted to: its formula bound to their columns, and the measured tau_R in MPa.
struct FitProblem {
  const BoundProgram& law; // scalars = parameters
  std::span<const double> measured;
  std::span<const Parameter> parameters; // bounds, which may be infinite
};

struct FitResult {
  std::vector<double> parameters;
  double cost = 0; // mean loss
  std::size_t evaluations = 0;
  std::string termination; // "converged: ...", "stopped: ..."
  // What the curvature has beyond that of the step's normal equations, learned from the steps; a
  // fit of the same law to similar rows may start with it.
  Eigen::MatrixXd correction;
};

// Whether a parameter's bounds say that it is a positive scale of unknown size: it is then searched
// and stepped by its logarithm.
inline bool is_scale(const Parameter& p) {
  return p.lower > 0 && p.upper > 1e5 * p.lower && p.upper < 1e300;
}

struct FitOptions {
  // Converged where the best step promises less than this share of the loss. 1e-10 of 44,550 rows
  // leaves the parameters within a hundredth of a standard error of the optimum.
  double tolerance = 1e-10;
  double damping = 1e-3; // of the first step; small where the start is known to be close
  std::size_t iterations = 200;
  const Eigen::MatrixXd* correction = nullptr; // of an earlier fit
};

// Levenberg-Marquardt on the loss's own normal equations (Marquardt 1963, damping by the gain
// ratio), with a symmetric rank-one correction where residuals are large and the law is curved
// (after Dennis, Gay and Welsch 1981); steps cut at the bounds and re-solved for the others;
// parameters that a bound holds are frozen. Sequential in row order: the same bits on any machine
// with the same libm, for any number of threads.
FitResult fit_from(const FitProblem& problem, const LossFunction& loss, std::vector<double> start,
                   const FitOptions& options = {});

} // namespace frictab
