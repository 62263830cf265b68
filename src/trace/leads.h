// Leads: what may be there, but is not in the law, and why not.
#pragma once

#include "trace/search.h"

namespace frictab::trace {

// Causes that the order of tests explains as well, each with the tests that would decide; then,
// behind the leads that are there already (findings that did not pay): what is left, strongest
// first, whatever chance may say. Where the tests are too few for any p-value, the strongest
// structures of single quantities, a recorded one before what is computed from it. Last what may
// follow from friction (followers.h), and goes with what `delivered` leaves.
void add_leads(Trace& trace, const Search& search, const Rival& delivered);

} // namespace frictab::trace
