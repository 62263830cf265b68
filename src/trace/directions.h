// What a fit could move: the directions in which a law with effects gives way, and what effects at
// each site would change.
#pragma once

#include "trace/rivals.h"

namespace frictab {

// Directions of what is fitted already, for a test of what is not: parameters, and a spline of each
// chosen quantity, so that a form that does not fit is not sold as another effect.
Eigen::MatrixXd fitted_directions(const Campaign& campaign, const Rival& rival,
                                  const Sensitivities& sensitivities);

// How tau_R changes with a factor on mu, with one on the limit, and with an addition of tau_scale.
// Over +-6 %, so that rows near the limit feel both.
Sensitivities sensitivities_of(const Campaign& campaign, const Rival& rival, double tau_scale_MPa);

} // namespace frictab
