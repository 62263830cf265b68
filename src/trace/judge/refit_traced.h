// Refit of a law with traced effects to all experiments, for deliver = "all".
#pragma once

#include <memory>

#include "calibrate/sandwich.h"
#include "trace/judge/delivery.h"

namespace frictab::trace {

// Fits the parameters of the law in `delivery` to all experiments under the same kind of weights,
// with the same effects. Its errors come from cross-validation: every fold refits the parameters
// but keeps the effects, which the search chose from tests that are left out there as well; the
// errors are therefore slightly too small, and a remark reports that. Returns nullptr, so the law
// stays as traced, if the law has no effects or is trained (its training has seen what would be
// left out), if a drift over the order of tests was removed, or if the data or a fold lack a
// column.
std::shared_ptr<const calibrate::ModelFit>
refit_traced(const Found& found, const Delivery& delivery, const data::Dataset& all);

// Completes the fit of a traced law by its standard errors, and by its errors on the tests to which
// it was fitted and their ranges.
void add_fitted_tests(calibrate::ModelFit& fit, const calibrate::Uncertainty& uncertainty,
                      const data::Dataset& tests, const TraceInput& in);

} // namespace frictab::trace
