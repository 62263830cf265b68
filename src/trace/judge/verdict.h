// Verdict of a trace, in one word and a few sentences.
#pragma once

#include "trace/search/search.h"

namespace frictab::trace {

// Fills verdict and remaining; everything else in `trace` must be complete. `contradicted`: in the
// validation tests a finding is worse than none.
void add_verdict(Trace& trace, const Found& found, bool contradicted);

// Whether tests that count as repeats scatter by more than any rig: they differ in something that
// no column records. The user's own repeatability is taken as it is.
bool repeats_differ(const Trace& trace);

} // namespace frictab::trace
