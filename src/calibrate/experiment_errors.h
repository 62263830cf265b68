// Errors of every law for every experiment: which test is the outlier?
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

struct ExperimentError {
  std::string experiment;
  bool held_out = false;
  std::size_t n_rows = 0;
  double mae_MPa = 0;
  double rmse_MPa = 0;
  double bias_MPa = 0; // mean of measured minus predicted, as in the ranking
  double gain = 0;     // factor of the law that fits this test best; NaN: it predicts no stress
};

struct ErrorsOfLaw {
  std::string law;
  std::vector<ExperimentError> experiments; // as filed, training first
};

// Laws as ranked.
std::vector<ErrorsOfLaw> errors_by_experiment(const Calibration& calibration,
                                              const data::Dataset& training,
                                              const data::Dataset& validation);

// CSV, one row per law and experiment: law, experiment, held_out (0 or 1), n, mae_MPa, rmse_MPa,
// bias_MPa, gain (empty where there is none).
std::string errors_csv(const std::vector<ErrorsOfLaw>& laws);

} // namespace frictab::calibrate
