// What an effect's looks cost, in log likelihood, before it is compared with others.
#pragma once

#include "trace/candidates.h"

namespace frictab {

// `column`: the one that the effect follows (of a pair, the first).
double implausibility(const PlacedEffect& effect, const CandidateColumn& column);

} // namespace frictab
