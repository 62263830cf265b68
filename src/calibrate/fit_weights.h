// What each row counts in a fit.
#pragma once

#include <vector>

#include "data/dataset.h"

namespace frictab::calibrate {

// The rows behind it (condensed data), over the square of the owner's standard uncertainty of its
// tau_R (column tau_R_error_MPa) where there is one, in the mean one of the latter. Whatever the
// loss. Empty: all rows alike. Errors of laws are never weighted by it: a row is a row there.
std::vector<double> fit_weights(const data::Dataset& data);

// Whether rows differ in that uncertainty.
bool has_uncertainties(const data::Dataset& data);

} // namespace frictab::calibrate
