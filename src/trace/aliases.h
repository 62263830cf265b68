// What the design of the tests ties to a state of the law: whether it acts, or the state, cannot be
// told, and the law's parameters have taken it.
//
// A label, or a number that tests hold, is tied to a state where its levels (of a number of many
// values, a straight line in it or its logarithm) explain more than 90 % of how the state's mean
// differs between tests (R^2, corrected for the number of levels). The standard error of its effect
// is then more than three times what it is in a design that crosses the two: (1 - R^2)^-1/2. A
// column with a level for more than half of the tests names tests. Not asked of states that the law
// takes for its shear limit alone.
#pragma once

#include "trace/trace.h"

namespace frictab::trace {

std::vector<Alias> find_aliases(const data::Dataset& training, const models::Model& model,
                                const TraceOptions& options);

} // namespace frictab::trace
