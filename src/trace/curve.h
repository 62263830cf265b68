// An effect for the eye, and what would settle which of two it is.
#pragma once

#include "trace/rivals.h"
#include "trace/trace.h"

namespace frictab {

// `parameter`: place of the effect's first one in the rival's parameters.
EffectCurve effect_curve(const Campaign& campaign, const Rival& rival,
                         const Sensitivities& sensitivities, std::size_t effect,
                         std::size_t parameter, const Eigen::MatrixXd& covariance);

// Where the two differ most: what to hold low and what high in the experiment that decides.
std::string deciding_experiment(const Rival& one, const Rival& other, const Candidates& candidates);

} // namespace frictab
