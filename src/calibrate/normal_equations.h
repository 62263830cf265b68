// Normal equations of a fit: the sums over rows that every step needs.
#pragma once

#include <functional>
#include <span>

#include <Eigen/Core>

#include "calibrate/fit.h"
#include "calibrate/sandwich.h"

namespace frictab::calibrate {

using stats::NormalEquations;

// Mean loss at one set of parameters, infinity if the law is not finite there; with its gradient
// and curvature.
double mean_cost(const FitProblem& problem, const LossFunction& loss,
                 std::span<const double> parameters);
NormalEquations normal_equations(const FitProblem& problem, const LossFunction& loss,
                                 std::span<const double> parameters);

// Sums scores and curvature (loss.curvature, not that of steps) over each experiment, at the
// optimum.
std::vector<ExperimentSums> sums_by_experiment(const FitProblem& problem, const LossFunction& loss,
                                               std::span<const double> parameters,
                                               std::span<const std::size_t> first_row);

} // namespace frictab::calibrate
