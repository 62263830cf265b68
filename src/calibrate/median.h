// Exact least absolute deviations in one parameter.
#pragma once

#include "calibrate/fit.h"

namespace frictab::calibrate {

// Refines the fit of a law with one parameter p: where tau = p g(state), the L1 optimum is the
// median of tau/g weighted by |g|. Elsewhere (limits, saturation) the law is linearised around the
// given fit, and the median is used if its mean |r| is smaller. Sets the cost to the mean |r|.
void exact_median(const FitProblem& problem, FitResult& fit);

} // namespace frictab::calibrate
