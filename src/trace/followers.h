// Columns that were measured along with friction, or known only after it: what goes with the
// residual there may follow from it, so it is a lead and never an effect.
#pragma once

#include <vector>

#include "trace/search.h"

namespace frictab::trace {

// Leads of channels and outcomes (data/roles.h) that go with what `rival` leaves, strongest first:
// within tests by one score per test, between tests by their means, each a t-test; p-values are
// those of all that was looked at together (Bonferroni), up to trace.alpha.
std::vector<Lead> leads_that_may_follow(const Search& search, const Rival& rival);

} // namespace frictab::trace
