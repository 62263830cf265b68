// The verdict of a trace, in one word and a few sentences.
#pragma once

#include "trace/search.h"

namespace frictab::trace {

// Fills verdict and remaining. `trace` is complete but for those. `contradicted`: the validation
// tests say that a finding is worse than nothing.
void add_verdict(Trace& trace, const Search& search, bool contradicted);

} // namespace frictab::trace
