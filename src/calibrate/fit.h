// Bounded nonlinear fit of a formula to measured shear stress.
//
// The fit minimises the mean loss of the residuals r = measured - tau(p) over the parameters p, by
// Levenberg-Marquardt (stats/levenberg_marquardt.h) with
//   g = mean of loss'(r) J,   H = mean of step curvature J' J,
// where J is d tau / d p.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "calibrate/loss.h"
#include "expr/program.h"
#include "models/law.h"
#include "stats/levenberg_marquardt.h"

namespace frictab::calibrate {

// Rows that a law is fitted to: its formula bound to their columns, and the measured tau_R in MPa.
struct FitProblem {
  const expr::BoundProgram& law; // scalars = parameters
  std::span<const double> measured;
  std::span<const models::Parameter> parameters; // bounds, which may be infinite
  std::span<const double> weights = {};          // of the rows in every mean; empty: equal
};

struct FitResult {
  std::vector<double> parameters;
  double cost = 0; // mean loss
  std::size_t evaluations = 0;
  std::string termination; // "converged: ...", "stopped: ..."
  // Correction of H at the end; a fit of the same law to similar rows may start with it.
  Eigen::MatrixXd correction;
  // No parameter changes any row there, as when the shear limit acts in all of them; agreement of
  // two such fits does not indicate a minimum.
  bool without_influence = false;
};

// Whether a parameter's bounds identify it as a positive scale of unknown size, which is searched
// and stepped by its logarithm.
inline bool is_scale(const models::Parameter& p) {
  return p.lower > 0 && p.upper > 1e5 * p.lower && p.upper < 1e300;
}

double mean_square(std::span<const double> values);

using FitOptions = stats::LevenbergMarquardtOptions;

// Runs the fit described above from one start. Sums run in row order: the same bits on any machine
// with the same libm, for any number of threads.
FitResult fit_from(const FitProblem& problem, const LossFunction& loss, std::vector<double> start,
                   FitOptions options = {});

} // namespace frictab::calibrate
