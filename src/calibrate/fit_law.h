// One law fitted to one set of experiments, by whatever way it is calibrated.
#pragma once

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Parameters with standard errors, how they were found, and the factors of the experiments; no
// errors on data.
ModelFit fit_law(const models::Law& law, const models::Conventions& conventions,
                 const data::Dataset& data, const CalibrationOptions& options);

} // namespace frictab::calibrate
