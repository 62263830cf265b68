// Laws of rate-and-state friction (data::SlipState). Their slip distance D_c enters the
// differential equation that the state follows through an experiment, not only the formula. So it
// is searched over its bounds, with all other parameters fitted at each try, and becomes a number
// in the delivered law.
#pragma once

#include <optional>

#include "calibrate/options.h"
#include "calibrate/sandwich.h"
#include "data/dataset.h"
#include "models/law.h"

namespace frictab::calibrate {

// Returns the index of the parameter that is the distance of the law's states; none if it has no
// such states.
std::optional<std::size_t> slip_distance(const models::Law& law,
                                         const models::Conventions& conventions);

// Returns the law at one distance, rounded to 4 digits, which is then no longer a parameter.
models::Law at_slip_distance(const models::Law& law, std::size_t parameter, double distance_mm);

struct SlipDistance {
  double distance_mm = 0;
  bool at_bound = false;
  std::size_t evaluations = 0; // fits of the other parameters
};

// Finds the distance with the least loss: a scan over the bounds, even in the logarithm, then
// Brent's method around the best.
SlipDistance find_slip_distance(const models::Law& law, std::size_t parameter,
                                const models::Conventions& conventions, const data::Dataset& data,
                                const CalibrationOptions& options);

// Standard errors of all parameters of `law`, including the slip distance D at index `parameter`,
// by one joint cluster sandwich (sandwich.h, recordings as clusters). D enters the formula to first
// order about the fitted D0 (`distance_mm`, rounded to 4 digits),
//   state(D) = state(D0) + (D - D0) d state/dD,
// with the derivative as a central difference of the state's solutions at 0.98 D0 and 1.02 D0
// (rounded likewise). The error of D thus includes its correlation with the other parameters, and
// their errors include the uncertainty of D. Histories of the law's own stress are fixed at its
// prediction. `fitted`: the model at_slip_distance of `distance_mm`. For a distance at its bound
// the caller (fit_law) reports no error.
Uncertainty slip_distance_uncertainty(const models::Law& law, std::size_t parameter,
                                      double distance_mm, const models::Model& fitted,
                                      const data::Dataset& data, const CalibrationOptions& options);

} // namespace frictab::calibrate
