// A penalised smooth of a quantity, its stiffness by restricted maximum likelihood: which quantity
// explains a residual best, whatever the form.
#pragma once

#include <Eigen/Core>

namespace frictab {

struct SmoothFit {
  // -2 log restricted likelihood, but for a constant that all smooths of one residual share: with
  // no smooth at all it is `without`. Smaller is better.
  double criterion = 0;
  double without = 0;
  double stiffness = 0; // what multiplies the penalty, in units of the whitened residual
  double freedom = 0;   // effective number of parameters
  Eigen::VectorXd coefficients;
};

// `residual` and `basis` whitened; `known`: orthonormal, whitened directions that are fitted beside
// the smooth. `penalty`: positive definite, over the basis' columns.
SmoothFit fit_smooth(const Eigen::VectorXd& residual, const Eigen::MatrixXd& basis,
                     const Eigen::MatrixXd& penalty, const Eigen::MatrixXd& known);

} // namespace frictab
