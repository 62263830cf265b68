// Experiments predicted by laws that have not seen them.
#pragma once

#include <span>
#include <vector>

#include "calibrate/calibration.h"

namespace frictab::calibrate {

// Without an experiment and those of its recording (data/recordings.h).
data::Dataset without_kin(const data::Dataset& data, std::size_t experiment);

// Per law, in the order given.
struct CrossValidation {
  std::vector<std::vector<models::Model>> without;  // per fold: the law fitted without it
  std::vector<std::vector<ExperimentError>> errors; // per experiment, by the fit without it
  std::vector<BandCheck> bands; // the same; `experiments` are those whose fit has a band
};

// fold_of: of each experiment, 0, 1, ... without a gap. Everything that calibration decides is
// decided anew in each fold, the network's weight decay included.
CrossValidation cross_validate(std::span<const models::Law* const> laws,
                               const models::Conventions& conventions, const data::Dataset& data,
                               const CalibrationOptions& options,
                               std::span<const std::size_t> fold_of);

} // namespace frictab::calibrate
