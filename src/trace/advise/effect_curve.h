// An effect as a curve with a band, for plots.
#pragma once

#include "trace/search/rivals.h"
#include "trace/trace.h"

namespace frictab::trace {

// Evaluates the curve. `parameter`: index of the effect's first one among the rival's parameters.
EffectCurve effect_curve(const Campaign& campaign, const Rival& rival,
                         const Sensitivities& sensitivities, std::size_t effect,
                         std::size_t parameter, const Eigen::MatrixXd& covariance);

} // namespace frictab::trace
