// Errors of every law for every experiment: which test is the outlier?
#pragma once

#include <string>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// CSV, one row per law and experiment, laws as ranked, experiments as filed: law, experiment,
// held_out (0 or 1), n, mae_MPa, rmse_MPa, bias_MPa (measured minus predicted, as in the ranking)
// and gain, the factor of the law that fits this test best (empty where the law predicts no
// stress).
std::string errors_by_experiment(const Calibration& calibration, const data::Dataset& training,
                                 const data::Dataset& validation);

} // namespace frictab::calibrate
