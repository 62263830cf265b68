// The noise that is left: its floor, and how much of it lies between experiments.
#pragma once

#include "trace/search.h"

namespace frictab {

// Fills noise_floor, scatter_between, its interval and lower bound, and repeatability where tests
// were repeated. The floor is the error that the noise model leaves to this law of the state, with
// the shape that the residuals have: what no law goes below if nothing else is missing.
void add_scatter(Trace& trace, const Search& search, const Rival& last);

} // namespace frictab
