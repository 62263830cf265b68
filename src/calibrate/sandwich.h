// Standard errors of fitted parameters, with the experiment as the statistical unit.
//
// The rows of an experiment share its lubricant, tool and operator, so their errors are alike and
// do not average out: counting rows as independent makes parameters look far better known than they
// are. The cluster sandwich (Liang and Zeger 1986) takes whole experiments for independent instead,
//   covariance = H^-1 (sum over experiments of s_e s_e') H^-1,
// with the curvature H of the loss and the score s_e, the sum of loss'(r) J over the rows of
// experiment e. A fit follows each experiment a little, which makes its score too small, by its
// leverage; CR2 (Bell and McCaffrey 2002) takes that out. The penalty of a penalised fit belongs to
// H, but has no scatter.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "models/law.h"

namespace frictab::calibrate {

// What one experiment says about the parameters at the optimum; J are the derivatives of its
// predicted values (tau_R in MPa, or whitened), r what is measured beyond them.
struct ExperimentSums {
  Eigen::VectorXd score;   // sum of loss'(r) J
  Eigen::MatrixXd hessian; // sum of curvature J'J
};

struct Uncertainty {
  // NaN where a parameter is held by a bound or not determined by the data; in the parameter's unit
  std::vector<double> std_error;
  std::vector<std::string> why_none; // per parameter: "at its bound"; empty where there is an error
  std::vector<std::string> remarks;  // in sentences, with what data would settle it
  // Where the data determine parameters only in combination, the fit has stopped anywhere along a
  // flat valley. These are the parameters moved along such directions to where they are nearest to
  // their default starts: to first order as good a fit, and a result that does not depend on the
  // path.
  std::vector<double> settled;
  // Of the parameters, for what is computed from several of them: 0 for those that are held, NaN
  // for those that one experiment alone determines. Directions that the data leave open are not in
  // it.
  Eigen::MatrixXd covariance;
  // What the design alone says, whatever the scatter: correlations of the parameters where all rows
  // scatter alike (from the inverse curvature; 0 beside one that is held), and the condition number
  // of the curvature, its diagonal scaled to 1 (infinite: determined only in combination; 0: not
  // known).
  Eigen::MatrixXd correlation;
  double condition = 0;
  // How far the parameters would move without one experiment (columns), to first order: the step
  // -(H - H_e)^-1 s_e of Gauss and Newton from the optimum of all; and their standard errors then,
  // from which its own scatter is taken out, or an outlier would hide itself.
  Eigen::MatrixXd moved_without, error_without;
};

// What is known of a law's stress: the covariance, but NaN for parameters at a bound. There they
// have no scatter, and nothing says where they would be without it.
Eigen::MatrixXd known_covariance(const Uncertainty& uncertainty);
// As models::Model::covariance has it.
std::vector<double> row_by_row(const Eigen::MatrixXd& matrix);

// The covariance described above. The 95 % interval of a parameter is +- the t-quantile with E-1
// degrees of freedom, for E experiments. `parameters` say the bounds of the fit, `values` where it
// ended, `sums` hold one entry per experiment. `penalty` (symmetric; empty: none) is what the fit
// adds to the curvature; it counts as data that do not scatter, so that stiff curves look as well
// known as the penalty makes them.
Uncertainty cluster_sandwich(std::span<const models::Parameter> parameters,
                             std::span<const double> values, std::span<const ExperimentSums> sums,
                             const Eigen::MatrixXd& penalty = {});

} // namespace frictab::calibrate
