// Predictions of experiments by laws fitted without them.
#pragma once

#include <span>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Returns the data without an experiment and those of its recording (data/recordings.h).
data::Dataset without_kin(const data::Dataset& data, std::size_t experiment);

// Results per law, in the order given.
struct CrossValidation {
  std::vector<std::vector<models::Model>> without;  // per fold: the law fitted without it
  std::vector<std::vector<ExperimentError>> errors; // per experiment, by the fit without it
  std::vector<BandCheck> bands; // of the same fits; `experiments` counts those whose fit has a band
};

// Cross-validates. fold_of: fold of each experiment, 0, 1, ... without a gap. Every decision of the
// calibration is repeated in each fold, the network's weight decay included.
CrossValidation cross_validate(std::span<const models::Law* const> laws,
                               const models::Conventions& conventions, const data::Dataset& data,
                               const CalibrationOptions& options,
                               std::span<const std::size_t> fold_of);

} // namespace frictab::calibrate
