// Errors on the source rows of condensed data, instead of on the means of blocks. Each call reads
// the files once, for any number of laws.
#pragma once

#include <span>
#include <vector>

#include "calibrate/beyond_ends.h"
#include "calibrate/calibration.h"
#include "calibrate/noise_floor.h"
#include "models/assembled_law.h"

namespace frictab::calibrate {

struct RowsToJudge {
  const data::Dataset* data; // condensed
  bool held_out = false;     // the law was fitted without its experiments
  // Per law: the one that predicts all experiments; or one per experiment, fitted without it.
  std::vector<std::vector<models::AssembledLaw>> laws = {};
};

// Results from the rows of one dataset.
struct RowFindings {
  std::vector<std::vector<ExperimentError>> errors; // per law and experiment
  std::vector<std::vector<RowsBeyond>> beyond;      // per law and experiment
  std::vector<stats::ErrorSums> scatter;            // per experiment: scatter_within
};

// Reads and judges the rows; one entry per dataset. Throws InputError if files have changed since
// they were condensed.
std::vector<RowFindings> judge_rows(std::span<const RowsToJudge> all);

// Fills ModelFit::on_rows and results derived from it: errors and band on training and validation
// experiments (judged_by; in leave-one-out by `without`), remarks on rows outside the clamped
// range. Does nothing if the data are not condensed.
ScatterWithin judge_on_rows(const std::vector<ModelFit*>& fits, const CalibrationInput& input);

} // namespace frictab::calibrate
