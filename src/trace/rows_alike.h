// A traced law with all rows alike, and the effects that nothing is left of then.
//
// Effects are found under the noise model (rivals.h). Where all rows weigh alike in the law that is
// delivered (delivery.h), its parameters are others, and an effect may have become none within its
// error: it would go into tables and routines and say nothing.
#pragma once

#include "trace/rivals.h"

namespace frictab::trace {

struct FittedAlike {
  Rival rival;
  std::vector<std::size_t> kept; // which of the effects are still in it
};

// Ordinary least squares. Then, one after another, the effect that is least certain is taken out
// and the rest fitted again, as long as there is one that at no block differs from "no effect", nor
// from its mean over all blocks, by more than its 95 % interval (cluster sandwich by test).
FittedAlike fit_rows_alike(const Campaign& campaign, const Rival& rival);

} // namespace frictab::trace
