// Standard errors of a rival's parameters, with the test as the statistical unit.
#pragma once

#include "calibrate/sandwich.h"
#include "trace/search/rivals.h"

namespace frictab::trace {

// Cluster sandwich of the residuals as whitened by the rival's weights.
calibrate::Uncertainty uncertainty_of(const Campaign& campaign, const Rival& rival);

} // namespace frictab::trace
