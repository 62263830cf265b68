// A law with traced effects, fitted again to all experiments: what deliver = "all" hands on.
#pragma once

#include <memory>

#include "trace/delivery.h"

namespace frictab::trace {

// The law of `delivery` with the same effects, its parameters fitted to all experiments under the
// same kind of weights. Errors to expect by cross-validation: the parameters are fitted anew in
// every fold, the effects stay those that the search has chosen, by tests that are left out there
// as well, so that they are a little too small, which is a remark. nullptr, and the law stays as it
// was traced: of a trained law (its training has seen what would be left out), and where a drift
// over the order of tests was taken out.
std::shared_ptr<const calibrate::ModelFit>
refit_traced(const Search& search, const Delivery& delivery, const data::Dataset& all);

} // namespace frictab::trace
