// Errors of every law for every experiment: which test is the outlier?
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "calibrate/resampling.h"

namespace frictab::calibrate {

struct ErrorsOfLaw {
  std::string law;
  std::vector<ExperimentError> experiments; // as filed, training first; left out: each once
};

ExperimentError error_of(const std::string& experiment, bool held_out, const ErrorSums& sums,
                         double gain);
// Of every experiment in `data`; `held_out` is what they are called.
std::vector<ExperimentError> experiment_errors(const models::Model& model,
                                               const data::Dataset& data, bool held_out);

// Back to sums over rows.
std::vector<ErrorSums> sums_of(const std::vector<ExperimentError>& errors);

// Of the law on the validation experiments; fit.unseen where there is one.
std::vector<ErrorSums> unseen_sums(const ModelFit& fit, const data::Dataset& validation);

// Laws as ranked.
std::vector<ErrorsOfLaw> errors_by_experiment(const Calibration& calibration,
                                              const data::Dataset& training,
                                              const data::Dataset& validation);

// CSV, one row per law and experiment: law, experiment, held_out (0 or 1), n, mae_MPa, rmse_MPa,
// bias_MPa, gain (empty where there is none).
std::string errors_csv(const std::vector<ErrorsOfLaw>& laws);

} // namespace frictab::calibrate
