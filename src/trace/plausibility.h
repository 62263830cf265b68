// A penalty for effects that fit where tests were run and are absurd elsewhere.
#pragma once

#include "trace/candidates.h"

namespace frictab::trace {

// In log likelihood, taken off before effects are compared: for changes of friction by half and
// more (as if changes were normal with a standard deviation of 50 %), and for humps between the
// values that were tested. `column`: the one that the effect follows (of a pair, the first).
double implausibility(const effects::PlacedEffect& effect, const CandidateColumn& column);

} // namespace frictab::trace
