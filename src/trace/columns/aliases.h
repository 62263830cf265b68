// Columns that the design of the tests confounds with a state of the law: the data cannot show
// which of the two acts, and the law's parameters have absorbed both.
//
// A label, or a number that is constant within tests, is confounded with a state if it explains
// more than 90 % of the variance of the state's test means (R^2, corrected for the number of
// levels; a number with many values explains by a straight line in it or in its logarithm). The
// standard error of its effect is then more than three times that in a design that crosses the two:
// (1 - R^2)^-1/2. Columns with a level for more than half of the tests are skipped as labels,
// because they name tests. States that the law uses for its shear limit alone are not checked.
#pragma once

#include "trace/trace.h"

namespace frictab::trace {

std::vector<Alias> find_aliases(const data::Dataset& training, const models::Model& model,
                                const TraceOptions& options);

} // namespace frictab::trace
