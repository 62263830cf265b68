// The data of a job: tests to calibrate on and tests to validate with.
#pragma once

#include <optional>
#include <string>

#include "calibrate/calibration.h"
#include "core/error.h"
#include "data/dataset.h"
#include "job/job.h"

namespace frictab::run {

struct JobData {
  data::Dataset training;
  data::Dataset validation; // no rows if each test is left out in turn
  calibrate::JudgedBy judged_by = calibrate::JudgedBy::validation_files;
  std::optional<data::Dataset> undivided; // both together, if frictab held some tests out
  // Both together if calibration.deliver = all and validation has its own files.
  std::optional<data::Dataset> together;
  bool delivers_all = false; // calibration.deliver

  // The tests on which prediction errors are measured.
  const data::Dataset& judged() const;
  // Training and validation together if delivered laws are fitted to both; else nullptr.
  const data::Dataset* all() const;
  calibrate::CalibrationInput calibration_input(const job::Job& job) const;
  // True if just two tests validate each other. A law's errors, |k1 - k2| at the states of one test
  // and of the other, then are a single observation, which allows
  // neither intervals nor comparisons of laws.
  bool shows_one_difference() const;
};

// Reads the files of [data]. Without validation files, a share of the experiments is held out from
// 30 experiments on, or if the job gives data.holdout; otherwise each is left out in turn. Throws
// InputError for files that cannot be used, for data.oracle with measured data, and for a name in
// [export.inputs] that is not a state, history or column.
JobData load_job_data(const job::Job& job);

// Same, but adds the faults of data with mostly implausible rows to `implausible` instead of
// throwing.
JobData load_job_data(const job::Job& job, FaultList& implausible);

} // namespace frictab::run
