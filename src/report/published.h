// What the paper ("benchmark of friction models on shear-stress level for cold forging") published,
// beside what this run found. The paper's figures refer to its own measurements.
#pragma once

#include <string>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab {

struct PublishedFigure {
  std::string what;      // "standard constants"
  std::string published; // "24 to 95": MAE of tau_R in MPa
  std::string ours;      // the same laws in this run, or "not in this run"
};

std::vector<PublishedFigure> published_figures(const Calibration& calibration);

// Parameters as one line: "mu = 0.0712 ± 0.0008, m = 0.31 ± 0.02"; many are only counted.
std::string parameters_text(const ModelFit& fit);

// "9.80 to 12.51", or "none: one experiment" and the like where resampling says nothing.
std::string interval_text(const Metrics& metrics, const Interval& interval);

bool has_interval(const Metrics& metrics);

} // namespace frictab
