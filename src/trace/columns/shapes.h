// Shapes that an effect of a cause may have; the factor of an effect over rows, and its
// uncertainty.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trace/columns/candidates.h"

namespace frictab::trace {

// One shape of an effect before it is fitted: amplitude 0, and the derivative of its factor by the
// amplitude.
struct GridShape {
  effects::PlacedEffect effect;
  Eigen::VectorXf direction; // per block, d factor/d amplitude at 0
};
std::vector<GridShape> shapes_of(const Cause& cause, const Candidates& candidates);

// Name of the form with the fewest parameters for a cause.
const char* plain_form(const Cause& cause, const Candidates& candidates);

// Derivatives of the factor by the amplitudes, per block: for forms that are linear in their
// amplitudes, at any values of these; for others at the effect's own values.
MatrixXd amplitude_basis(const effects::PlacedEffect& effect, const BlockColumns& columns);

// Returns the columns of the effect's inputs, in their order.
std::vector<const double*> inputs_on(const effects::PlacedEffect& effect,
                                     const BlockColumns& columns);

// Returns the effect's factor, per block.
VectorXd factor_on(const effects::PlacedEffect& effect, const BlockColumns& columns);

// Roughness matrix of a smooth effect's amplitudes.
MatrixXd roughness_of(const effects::PlacedEffect& effect);

// Returns an effect of that form with the form's own start values; for a category, with all levels.
effects::PlacedEffect start_effect(const effects::EffectForm& form, const Cause& cause,
                                   const Candidates& candidates, effects::ActsOn acts_on,
                                   double tau_scale_MPa);
// Limits the shape parameters of effects to what the data can determine: positions to the range;
// widths to 1/60 to 6 times the range and, for local forms, to at least half of the widest gap
// between tested values, because data cannot show structure inside a gap.
void bound_shapes(models::Law& extended, std::size_t own_parameters,
                  std::span<const effects::PlacedEffect> effects, const Candidates& candidates);

// Returns a penalty in log likelihood on effects that fit where tests were run and are absurd
// elsewhere: for large changes of friction (as if changes were normal with a standard deviation of
// 50 %), and for humps between tested values. `column`: the one that the effect follows (for a
// pair, the first).
double implausibility(const effects::PlacedEffect& effect, const CandidateColumn& column);

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
