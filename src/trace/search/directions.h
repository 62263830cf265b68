// Derivatives of tau_R by fitted parameters, to be projected out of tests, and by an effect's
// factor at each site.
#pragma once

#include "trace/search/rivals.h"

namespace frictab::trace {

// Directions that count as fitted: those of all parameters and, for each effect in the law, of any
// form of its quantity (straight lines between seven values). Otherwise the misfit of the chosen
// form would be found as another effect of the same quantity.
Eigen::MatrixXd fitted_directions(const Campaign& campaign, const Rival& rival,
                                  const Sensitivities& sensitivities);

// Derivatives of tau_R by a factor on mu, on the limit, on both, and by an addition of tau_scale.
// Central differences over +-6 %, so that rows near the limit respond to mu as well as to the
// limit.
Sensitivities sensitivities_of(const Campaign& campaign, const Rival& rival, double tau_scale_MPa);

} // namespace frictab::trace
