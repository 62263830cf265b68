// Penalty on effects that fit where tests were run and are absurd elsewhere.
#pragma once

#include "trace/columns/candidates.h"

namespace frictab::trace {

// Returns the penalty in log likelihood, subtracted before effects are compared: for large changes
// of friction (as if changes were normal with a standard deviation of 50 %), and for humps between
// tested values. `column`: the one that the effect follows (for a pair, the first).
double implausibility(const effects::PlacedEffect& effect, const CandidateColumn& column);

} // namespace frictab::trace
