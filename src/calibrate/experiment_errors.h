// Errors of every law for every experiment, which show outlying tests.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "stats/resampling.h"

namespace frictab::calibrate {

struct ErrorsOfLaw {
  std::string law;
  // in file order, training first; in leave-one-out each once
  std::vector<ExperimentError> experiments;
};

ExperimentError error_of(const std::string& experiment, bool held_out, const stats::ErrorSums& sums,
                         double gain);
// Computes the errors of every experiment in `data`; `held_out`: whether the law was fitted without
// them.
std::vector<ExperimentError> experiment_errors(const models::Model& model,
                                               const data::Dataset& data, bool held_out);

// Converts errors back to sums over rows.
std::vector<stats::ErrorSums> sums_of(const std::vector<ExperimentError>& errors);
// The same with the recordings of the data that the errors are of, which files do not contain.
std::vector<stats::ErrorSums> sums_of(const std::vector<ExperimentError>& errors,
                                      const data::Dataset& of);

// Computes errors with intervals over these experiments.
Metrics metrics_of(const std::vector<ExperimentError>& errors, const CalibrationOptions& options);

// Returns the sums of the law on the validation experiments, or of fit.unseen if it has any.
std::vector<stats::ErrorSums> unseen_sums(const ModelFit& fit, const data::Dataset& validation);

// Collects the errors of all laws in ranking order.
std::vector<ErrorsOfLaw> errors_by_experiment(const Calibration& calibration,
                                              const data::Dataset& training,
                                              const data::Dataset& validation);

// CSV, one row per law and experiment: law, experiment, held_out (0 or 1), n, mae_MPa, rmse_MPa,
// bias_MPa, gain (empty where there is none).
std::string errors_csv(const std::vector<ErrorsOfLaw>& laws);

} // namespace frictab::calibrate
