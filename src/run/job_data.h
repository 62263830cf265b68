// The data of a job: tests to calibrate on and tests to judge by.
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
  data::Dataset validation; // no rows where each test is left out in turn
  calibrate::JudgedBy judged_by = calibrate::JudgedBy::validation_files;
  std::optional<data::Dataset> undivided; // both together, where the tool held some out
  std::optional<data::Dataset> together;  // deliver = all: both, where they are files of their own
  bool delivers_all = false;              // calibration.deliver
  std::string leak;                       // calibrate::leak_note

  // The tests that errors of prediction are taken on.
  const data::Dataset& judged() const;
  // Training and validation together, where delivered laws are fitted to both; else nullptr.
  const data::Dataset* all() const;
  calibrate::CalibrationInput calibration_input(const job::Job& job) const;
  // Two tests that judge each other: the errors of a law, |k1 - k2| at one test's states and at the
  // other's, are no two observations. Such data give no intervals and compare no laws.
  bool shows_one_difference() const;
};

// Reads the files of [data]. Without validation files a share of the experiments is held out where
// there are 30 or the job gives data.holdout; of fewer, each is left out in turn. Throws
// InputError for files that cannot be used, for data.oracle with measured data, and where
// [export.inputs] names what is no state, history or column.
JobData load_job_data(const job::Job& job);

// The same without an error where most rows are implausible: what is then goes to `faults`.
JobData load_job_data(const job::Job& job, FaultList& implausible);

} // namespace frictab::run
