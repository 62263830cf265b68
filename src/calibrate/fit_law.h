// Fit of one law to one set of experiments, by the law's own method.
#pragma once

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Returns parameters with standard errors, a record of the fit, and the factors of the experiments;
// no errors on data.
ModelFit fit_law(const models::Law& law, const models::Conventions& conventions,
                 const data::Dataset& data, const CalibrationOptions& options);

} // namespace frictab::calibrate
