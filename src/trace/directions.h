// Derivatives of tau_R: by what is fitted already, so that a test can take it out, and by an
// effect's factor at each site.
#pragma once

#include "trace/rivals.h"

namespace frictab::trace {

// Directions of what is fitted already: all parameters, and for each effect in the law any form of
// its quantity (straight lines between seven values). Otherwise the misfit of a chosen form would
// be found as another effect of the same quantity.
Eigen::MatrixXd fitted_directions(const Campaign& campaign, const Rival& rival,
                                  const Sensitivities& sensitivities);

// How tau_R changes with a factor on mu, on the limit, on both, and with an addition of tau_scale.
// Central differences over +-6 %, so that rows near the limit feel mu as well as the limit.
Sensitivities sensitivities_of(const Campaign& campaign, const Rival& rival, double tau_scale_MPa);

} // namespace frictab::trace
