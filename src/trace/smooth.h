// A penalised smooth of a quantity: how well the quantity can explain a residual, whatever the
// form.
//
// The residual is taken for B c + noise, with c normal of precision (stiffness x penalty): a stiff
// smooth is nearly straight, a soft one follows every knot. The stiffness is the one of the largest
// restricted likelihood (Patterson and Thompson 1971), so that a quantity is not preferred because
// its curve was allowed to bend more. With B' B and the penalty diagonal in the same coordinates
// (one generalised eigenproblem), each stiffness that is tried costs a sum over the coordinates.
#pragma once

#include <Eigen/Core>

namespace frictab::trace {

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

} // namespace frictab::trace
