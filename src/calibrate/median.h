// Least absolute deviations in one parameter, exactly.
#pragma once

#include "calibrate/fit.h"

namespace frictab::calibrate {

// For a law with one parameter p: where tau = p g(state), the L1 optimum is the median of tau/g
// weighted by |g|. Elsewhere (limits, saturation) the law is taken as linear around the given fit,
// and the median replaces it where its mean |r| is smaller. Sets cost to the mean |r|.
void exact_median(const FitProblem& problem, FitResult& fit);

} // namespace frictab::calibrate
