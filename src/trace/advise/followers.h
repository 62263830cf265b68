// Columns that were measured along with friction or are known only after it. If they correlate with
// the residual, they may be its consequence, so each is a lead and never an effect.
#pragma once

#include <vector>

#include "trace/search/search.h"

namespace frictab::trace {

// Returns channels and outcomes (data/roles.h) that correlate with the residual of `rival`,
// strongest first: within tests by one score per test, between tests by test means, each with a
// t-test. The p-values are corrected for all comparisons (Bonferroni); leads have at most
// trace.alpha.
std::vector<Lead> leads_that_may_follow(const Search& search, const Rival& rival);

} // namespace frictab::trace
