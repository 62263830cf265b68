// Bounded nonlinear fit of a formula to measured shear stress.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calibrate/loss.h"
#include "expr/program.h"
#include "models/law.h"

namespace frictab {

// The rows a law is fitted to: its formula bound to their columns, and the measured tau_R in MPa.
struct FitProblem {
  const BoundProgram& law; // scalars = parameters
  std::span<const double> measured;
  std::span<const Parameter> parameters; // bounds
};

struct FitResult {
  std::vector<double> parameters;
  double cost = 0; // mean loss
  std::size_t evaluations = 0;
  std::string termination; // "converged: ...", "stopped: ..."
};

// Levenberg-Marquardt on reweighted least squares (Marquardt 1963), steps kept inside the bounds,
// parameters that a bound holds are frozen. Sequential in row order: the same bits on any machine
// with the same libm, for any number of threads.
FitResult fit_from(const FitProblem& problem, const LossFunction& loss, std::vector<double> start);

// Start by NLopt's DIRECT-L over the bounds on `coarse` (a thinned copy of the rows), beside the
// law's default start and a few Halton points; the best survivors are polished on `full`.
FitResult fit_global(const FitProblem& coarse, const FitProblem& full, Loss loss,
                     double huber_delta_MPa);

// Standard errors by the cluster sandwich with whole experiments as clusters (Liang and Zeger
// 1986), factor E/(E-1). NaN where a parameter is held by a bound or not determined by the data;
// `remarks` says which and why.
struct Uncertainty {
  std::vector<double> std_error;
  std::vector<std::string> remarks;
  // The parameters moved along the directions that the data do not determine, to where they are
  // nearest to their default starts: to first order as good a fit, without arbitrary values.
  std::vector<double> settled;
};
Uncertainty cluster_sandwich(const FitProblem& problem, const LossFunction& loss,
                             std::span<const double> parameters,
                             std::span<const std::size_t> first_row);

} // namespace frictab
