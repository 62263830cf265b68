// The factor of an effect over rows of its columns, and how well it is known.
#pragma once

#include <span>

#include <Eigen/Dense>

#include "effects/effect.h"

namespace frictab::trace {

struct FactorOnRows {
  Eigen::VectorXd factor; // 1: no effect
  Eigen::MatrixXd slope;  // rows x fitted parameters: its derivative by each
};

// `columns`: of the effect's inputs, in their order.
FactorOnRows factor_on_rows(const effects::PlacedEffect& effect,
                            std::span<const double* const> columns, Eigen::Index rows);

// Of quantities with these slopes, to first order: sqrt(g' C g) per row, with C the covariance of
// the parameters. NaN where a parameter that acts in a row has no known error.
Eigen::VectorXd std_errors(const Eigen::MatrixXd& slope, const Eigen::MatrixXd& covariance);

} // namespace frictab::trace
