// What a trace comes to, in one word and a few sentences.
#pragma once

#include "trace/search.h"

namespace frictab {

// Behind the leads that are there already: what is left, strongest first, whatever chance may say.
void add_leads(Trace& trace, const Search& search);

// Fills verdict and remaining. `trace` is complete but for those.
void add_verdict(Trace& trace, const Search& search);

} // namespace frictab
