// What stays unexplained: the noise floor, and how much of the scatter lies between experiments.
#pragma once

#include "trace/search.h"

namespace frictab::trace {

// Fills noise_floor, scatter_between, its interval and lower bound, and repeatability where tests
// were repeated. The floor is the RMSE that the noise model expects of an exact law, and the MAE
// that belongs to it by the ratio that the residuals have: no law goes below, if nothing else is
// missing. It is not above what the law as it was calibrated leaves, but for the share that its
// parameters have taken.
void add_scatter(Trace& trace, const Search& search, const Rival& last);

} // namespace frictab::trace
