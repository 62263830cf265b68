// Standard errors of fitted parameters, with the experiment as the statistical unit.
//
// The rows of an experiment share its lubricant, tool and operator, so their errors are alike and
// do not average out: treating rows as independent makes parameters look far more certain than they
// are. The cluster sandwich (Liang and Zeger 1986) assumes only whole experiments to be
// independent,
//   covariance = H^-1 (sum over experiments of s_e s_e') H^-1,
// with the curvature H of the loss and the score s_e, the sum of loss'(r) J over the rows of
// experiment e. A fit follows each experiment a little, which makes its score too small, by its
// leverage; CR2 (Bell and McCaffrey 2002) corrects that. The penalty of a penalised fit belongs to
// H, but has no scatter.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/law.h"

namespace frictab::calibrate {

// Sums over one experiment at the optimum; J are the derivatives of its predicted values (tau_R in
// MPa, or whitened), r is measured minus predicted.
struct ExperimentSums {
  Eigen::VectorXd score;   // sum of loss'(r) J
  Eigen::MatrixXd hessian; // sum of curvature J'J
};

struct Uncertainty {
  // in the parameter's unit; NaN if a parameter is at a bound or not determined by the data
  std::vector<double> std_error;
  std::vector<std::string> why_none; // per parameter: "at its bound"; empty if it has an error
  std::vector<std::string> remarks;  // sentences, with the data that would determine a parameter
  // Parameters moved along flat directions of the loss, as near as possible to their default
  // starts. Where the data determine parameters only in combination, the fit stops anywhere along a
  // flat valley; these are to first order an equally good fit, and do not depend on the path of the
  // solver.
  std::vector<double> settled;
  // Covariance of the parameters, for quantities computed from several of them: 0 for those at a
  // bound, NaN for those that a single experiment determines. Directions that the data leave open
  // are excluded.
  Eigen::MatrixXd covariance;
  // Properties of the design alone, for any scatter: correlations of the parameters if all rows
  // scatter alike (from the inverse curvature; 0 with a parameter at a bound), and the condition
  // number of the curvature with its diagonal scaled to 1 (infinite: determined only in
  // combination; 0: not known).
  Eigen::MatrixXd correlation;
  double condition = 0;
  // Shift of the parameters without one experiment (columns), to first order: the Gauss-Newton step
  // -(H - H_e)^-1 s_e from the optimum of all; and their standard errors without it. These exclude
  // its own scatter, otherwise an outlier would mask itself.
  Eigen::MatrixXd moved_without, error_without;
};

// Covariance for errors of a law's stress: NaN for parameters at a bound, because their values
// without it are unknown.
Eigen::MatrixXd known_covariance(const Uncertainty& uncertainty);
// Converts to the layout of models::Model::covariance.
std::vector<double> row_by_row(const Eigen::MatrixXd& matrix);

// Computes the covariance described above. The 95 % interval of a parameter is +- the t-quantile
// with E-1 degrees of freedom, for E experiments. `parameters` have the bounds of the fit, `values`
// its result, `sums` one entry per experiment. `penalty` (symmetric; empty: none) is the curvature
// that the fit adds; it counts as data without scatter, so that stiff curves appear as certain as
// the penalty makes them.
Uncertainty cluster_sandwich(std::span<const models::Parameter> parameters,
                             std::span<const double> values, std::span<const ExperimentSums> sums,
                             const Eigen::MatrixXd& penalty = {});

} // namespace frictab::calibrate
