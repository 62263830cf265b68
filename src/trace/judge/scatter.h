// Unexplained scatter: the noise floor, and the part of the scatter that lies between experiments.
#pragma once

#include "trace/search/search.h"

namespace frictab::trace {

// Fills noise_floor, scatter_between, its interval and lower bound, and repeatability where tests
// were repeated. The floor is the RMSE that the noise model expects of an exact law, and the
// corresponding MAE by the ratio that the residuals have: if nothing else is missing, no law has a
// smaller error. It is capped at the calibrated law's RMSE, corrected for the degrees of freedom.
void add_scatter(Trace& trace, const Search& search, const Rival& last);

} // namespace frictab::trace
