// Leads: effects that may exist but are not in the law, with the reason.
#pragma once

#include "trace/search.h"

namespace frictab::trace {

// Appends leads after those already present (findings that did not improve predictions). First,
// causes that the order of tests explains as well, each with the tests that would decide. Then the
// strongest unexplained terms, also those that chance may explain; where the tests are too few for
// any p-value, the strongest single quantities, recorded ones before those computed from them.
// Last, columns that may follow from friction (followers.h) and correlate with the residual of
// `delivered`.
void add_leads(Trace& trace, const Search& search, const Rival& delivered);

} // namespace frictab::trace
