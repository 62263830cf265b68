// An effect as a curve with a band, for plots.
#pragma once

#include "trace/search/rivals.h"
#include "trace/trace.h"

namespace frictab::trace {

// Evaluates the curve of one of the rival's effects.
EffectCurve effect_curve(const Campaign& campaign, const Rival& rival,
                         const Sensitivities& sensitivities, std::size_t effect,
                         const MatrixXd& covariance);

} // namespace frictab::trace
