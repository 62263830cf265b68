// Penalised smooth of a quantity: measures how well the quantity can explain a residual,
// independently of a form.
//
// The model of the residual is B c + noise, with c normal of precision (stiffness x penalty): a
// stiff smooth is nearly straight, a soft one follows every knot. The stiffness maximises the
// restricted likelihood (Patterson and Thompson 1971), so that a quantity is not preferred because
// its curve may bend more. B' B and the penalty are diagonal in common coordinates (one generalised
// eigenproblem), so each stiffness tried costs a sum over the coordinates.
#pragma once

#include <Eigen/Core>

namespace frictab::stats {

struct SmoothFit {
  // -2 log restricted likelihood, up to a constant that all smooths of one residual share;
  // `without` is its value without a smooth. Smaller is better.
  double criterion = 0;
  double without = 0;
  double stiffness = 0; // multiplier of the penalty, in units of the whitened residual
  double freedom = 0;   // effective number of parameters
  Eigen::VectorXd coefficients;
};

// Fits the smooth. `residual` and `basis` are whitened; `known`: orthonormal, whitened directions
// that are fitted together with the smooth. `penalty`: positive definite, over the basis' columns.
SmoothFit fit_smooth(const Eigen::VectorXd& residual, const Eigen::MatrixXd& basis,
                     const Eigen::MatrixXd& penalty, const Eigen::MatrixXd& known);

} // namespace frictab::stats
