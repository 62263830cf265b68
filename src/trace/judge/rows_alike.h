// Standard errors of a rival's parameters; its fit with equal weights for all rows, and removal of
// effects that vanish in it.
//
// Effects are found under the noise model (rivals.h). Where the delivered law weighs all rows
// equally (delivery.h), its parameters differ, and the confidence interval of an effect may include
// "no effect": the effect would burden tables and routines for nothing.
#pragma once

#include "calibrate/sandwich.h"
#include "trace/search/rivals.h"

namespace frictab::trace {

// Returns standard errors with the test as the statistical unit: the cluster sandwich of the
// residuals as whitened by the rival's weights.
calibrate::Uncertainty uncertainty_of(const Campaign& campaign, const Rival& rival);

struct FittedAlike {
  Rival rival;
  std::vector<std::size_t> kept; // indices of the effects that are still in it
};

// Fits by ordinary least squares. Then repeatedly removes the least certain effect and refits the
// rest, as long as that effect differs at no block by more than its 95 % interval (cluster sandwich
// by test) from "no effect", or from its mean over all blocks.
FittedAlike fit_rows_alike(const Campaign& campaign, const Rival& rival);

} // namespace frictab::trace
