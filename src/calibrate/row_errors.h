// A second look at the rows behind condensed data: what laws make of every row, not of the means of
// blocks. Every look reads the files once, whatever number of laws is asked for.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "calibrate/beyond_ends.h"
#include "calibrate/calibration.h"
#include "calibrate/noise_floor.h"
#include "models/assembled_law.h"

namespace frictab::calibrate {

// What the rows of one dataset say.
struct RowFindings {
  std::vector<std::vector<ExperimentError>> errors; // per law and experiment
  std::vector<RowsBeyond> beyond;                   // per law
  std::vector<ErrorSums> scatter;                   // per experiment: scatter_within
};

// The law that predicts an experiment: one for all, or that which was fitted without it.
using LawOfExperiment =
    std::function<const models::AssembledLaw&(std::size_t law, std::size_t experiment)>;

struct RowsToJudge {
  const data::Dataset* data; // condensed
  bool held_out = false;     // what its experiments are called
  LawOfExperiment law;
};

// One entry per dataset. Throws InputError where the files have changed since they were condensed.
std::vector<RowFindings> look_at_rows(std::span<const RowsToJudge> all, std::size_t laws);

// Fills ModelFit::on_rows and what follows from it: errors and band on training and validation
// experiments (judged_by; experiments left out: by `without`), remarks on rows beyond the ends.
// Nothing where the data hold their rows.
ScatterWithin judge_on_rows(const std::vector<ModelFit*>& fits, const CalibrationInput& input);

} // namespace frictab::calibrate
