// The shapes that an effect of a cause may have.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "trace/candidates.h"

namespace frictab::trace {

// One shape of an effect before it is fitted: amplitude 0, and what its factor changes per
// amplitude.
struct GridShape {
  effects::PlacedEffect effect;
  Eigen::VectorXf direction; // per block, d factor/d amplitude at 0
};
std::vector<GridShape> shapes_of(const Cause& cause, const Candidates& candidates);

// Per block and amplitude, d factor/d amplitude: of forms that are linear in their amplitudes,
// whatever these are; of others at the effect's own values.
Eigen::MatrixXd amplitude_basis(const effects::PlacedEffect& effect, const BlockColumns& columns);

// Its factor, per block.
Eigen::VectorXd factor_on(const effects::PlacedEffect& effect, const BlockColumns& columns);

// Roughness of a smooth effect's amplitudes.
Eigen::MatrixXd roughness_of(const effects::PlacedEffect& effect);

// An effect of that form with the form's own start values; category: all levels.
effects::PlacedEffect start_effect(const effects::EffectForm& form, const Cause& cause,
                                   const Candidates& candidates, effects::ActsOn acts_on,
                                   double tau_scale_MPa);
// Whether the form has a meaning for the cause: logarithms need positive values, ...
bool form_fits(const effects::EffectForm& form, const Cause& cause, const Candidates& candidates);
// Bounds of a fit inside what the data can tell: positions inside the range, widths like it, and
// not below half of the widest gap between values that were tested: what lies there nobody has
// seen.
void bound_shapes(models::Law& extended, std::size_t own_parameters,
                  std::span<const effects::PlacedEffect> effects, const Candidates& candidates);

} // namespace frictab::trace
