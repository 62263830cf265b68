// Fit of one law to one set of experiments, by the law's own method.
#pragma once

#include <functional>

#include "calibrate/calibration.h"
#include "calibrate/input_columns.h"

namespace frictab::calibrate {

// Returns parameters with standard errors, a record of the fit, and the factors of the experiments;
// no errors on data.
ModelFit fit_law(const models::Law& law, const models::Conventions& conventions,
                 const data::Dataset& data, const CalibrationOptions& options);

// Fills in the errors of a fit; `fitted`: its prediction of the rows that it was fitted to.
using JudgeFit =
    std::function<void(ModelFit& fit, const models::AssembledLaw& law, const Predicted& fitted)>;
// Returns the fit with the range of its data, its open parameters, what `judge` adds, and the time
// that all of this took.
ModelFit fit_and_judge(const models::Law& law, const models::Conventions& conventions,
                       const data::Dataset& data, const CalibrationOptions& options,
                       const JudgeFit& judge);

} // namespace frictab::calibrate
