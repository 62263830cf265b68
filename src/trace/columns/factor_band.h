// The factor of an effect over rows of its columns, and its uncertainty.
#pragma once

#include <span>

#include "effects/effect.h"
#include "trace/basics.h"

namespace frictab::trace {

// Step of a parameter by which derivatives are differences.
double derivative_step(double parameter);

struct FactorOnRows {
  VectorXd factor; // 1: no effect
  MatrixXd slope;  // rows x fitted parameters: its derivatives
};

// Evaluates the factor. `columns`: those of the effect's inputs, in their order.
FactorOnRows factor_on_rows(const effects::PlacedEffect& effect,
                            std::span<const double* const> columns, Index rows);

// Standard errors of quantities with these derivatives, to first order: sqrt(g' C g) per row, where
// C is the covariance of the parameters. NaN where a parameter with a non-zero derivative has no
// known error.
VectorXd std_errors(const MatrixXd& slope, const MatrixXd& covariance);

} // namespace frictab::trace
