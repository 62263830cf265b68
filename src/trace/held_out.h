// What a law with effects is worth on experiments it was not fitted to.
#pragma once

#include <cstdint>

#include "trace/rivals.h"

namespace frictab {

// Per experiment, the sum of absolute errors of its blocks over the number of all blocks, predicted
// by fits without its fold (of five); under the better of two weightings (the noise model's, all
// rows alike), which is how the law would be delivered.
Eigen::VectorXd held_out_errors(const Campaign& campaign, const Rival& rival, std::uint64_t seed);

// Whether left-out experiments are predicted better, by more than rounding.
bool pays(const Eigen::VectorXd& without, const Eigen::VectorXd& with);

// The parameters that are handed on: by the noise model's weights, or by plain least squares where
// those predict left-out experiments clearly better (a law that is wrong may lean on the few rows
// that are least correlated with others).
Rival delivered(const Campaign& campaign, const Rival& rival, std::uint64_t seed);

} // namespace frictab
