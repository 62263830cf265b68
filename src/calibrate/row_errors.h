// Errors on the source rows of condensed data, instead of on the means of blocks. Each call reads
// the files once, for any number of laws.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "calibrate/beyond_ends.h"
#include "calibrate/calibration.h"
#include "calibrate/noise_floor.h"
#include "models/assembled_law.h"

namespace frictab::calibrate {

// Results from the rows of one dataset.
struct RowFindings {
  std::vector<std::vector<ExperimentError>> errors; // per law and experiment
  std::vector<RowsBeyond> beyond;                   // per law
  std::vector<stats::ErrorSums> scatter;            // per experiment: scatter_within
};

// Selects the law that predicts an experiment: one for all, or the one fitted without it.
using LawOfExperiment =
    std::function<const models::AssembledLaw&(std::size_t law, std::size_t experiment)>;

struct RowsToJudge {
  const data::Dataset* data; // condensed
  bool held_out = false;     // the law was fitted without its experiments
  LawOfExperiment law;
};

// Reads and judges the rows; one entry per dataset. Throws InputError if files have changed since
// they were condensed.
std::vector<RowFindings> look_at_rows(std::span<const RowsToJudge> all, std::size_t laws);

// Fills ModelFit::on_rows and results derived from it: errors and band on training and validation
// experiments (judged_by; in leave-one-out by `without`), remarks on rows outside the clamped
// range. Does nothing if the data are not condensed.
ScatterWithin judge_on_rows(const std::vector<ModelFit*>& fits, const CalibrationInput& input);

} // namespace frictab::calibrate
