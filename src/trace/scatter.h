// The noise that is left: its floor, and how much of it lies between experiments.
#pragma once

#include "trace/rivals.h"
#include "trace/trace.h"

namespace frictab {

// Fills noise_floor, scatter_between, its interval and its lower bound. The floor is the error that
// the noise model leaves to a law of the state, with the shape that the residuals have.
void add_scatter(Trace& trace, const Campaign& campaign, const Rival& last,
                 const Dataset& training);

} // namespace frictab
