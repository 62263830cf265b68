// Weights of rows in a fit.
#pragma once

#include <vector>

#include "data/dataset.h"

namespace frictab::calibrate {

// Returns the weight of each row, for any loss: the number of rows it represents (condensed data),
// divided by the square of the user's standard uncertainty of its tau_R (column tau_R_error_MPa)
// where given; the latter factor is scaled to a mean of 1. Empty: equal weights. Errors of laws are
// never weighted by the uncertainty: there every row counts as one.
std::vector<double> fit_weights(const data::Dataset& data);

// Whether rows differ in that uncertainty.
bool has_uncertainties(const data::Dataset& data);

} // namespace frictab::calibrate
