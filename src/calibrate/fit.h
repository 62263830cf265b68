// Bounded nonlinear fit of a formula to measured shear stress.
//
// Minimised is the mean loss of the residuals r = measured - tau(p) over the parameters p. A step d
// solves the damped normal equations
//   (H + damping D) d = g,   g = mean of loss'(r) J,   H = mean of step curvature J' J,
// J being d tau / d p and D the largest diagonal of H so far (Levenberg-Marquardt: Marquardt 1963,
// More 1978). Damping falls where the loss decreases as H promised, and rises where it does not. H
// leaves out the law's own curvature, which counts where residuals are large: a symmetric rank-one
// correction of H learns it from the change of g along each step (after Dennis, Gay and Welsch
// 1981). A step that would leave the bounds is cut there and solved again for the other parameters.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calibrate/loss.h"
#include "expr/program.h"
#include "models/law.h"

namespace frictab::calibrate {

// The rows a law is fitted to: its formula bound to their columns, and the measured tau_R in MPa.
struct FitProblem {
  const expr::BoundProgram& law; // scalars = parameters
  std::span<const double> measured;
  std::span<const models::Parameter> parameters; // bounds, which may be infinite
  std::span<const double> weights = {};          // of the rows in every mean; empty: all alike
};

struct FitResult {
  std::vector<double> parameters;
  double cost = 0; // mean loss
  std::size_t evaluations = 0;
  std::string termination; // "converged: ...", "stopped: ..."
  // The rank-one correction of H, as it was in the end; a fit of the same law to similar rows may
  // start with it.
  Eigen::MatrixXd correction;
  // No parameter moves any row there, as where the shear limit holds in all of them: that two fits
  // end so says nothing of a minimum.
  bool without_influence = false;
};

// Whether a parameter's bounds say that it is a positive scale of unknown size: it is then searched
// and stepped by its logarithm.
inline bool is_scale(const models::Parameter& p) {
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

// The fit described above, from one start. Sums run in row order: the same bits on any machine with
// the same libm, for any number of threads.
FitResult fit_from(const FitProblem& problem, const LossFunction& loss, std::vector<double> start,
                   const FitOptions& options = {});

} // namespace frictab::calibrate
