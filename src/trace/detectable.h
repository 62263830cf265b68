// Statistical power: how large an effect this campaign could have shown, column by column.
#pragma once

#include "trace/search.h"

namespace frictab::trace {

// Plants a straight line in each quantity (one factor per level in a text column) into the
// campaign's own residuals, their signs flipped by experiment, and finds the size that passes the
// family-wise threshold in 80 % of the flips. Fills trace.detectable.
void add_detectable(Trace& trace, const Search& search, std::uint64_t seed);

} // namespace frictab::trace
