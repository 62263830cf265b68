// The data of a job: tests to calibrate on and tests to judge by.
#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "data/dataset.h"
#include "job/job.h"

namespace frictab::run {

struct JobData {
  data::Dataset training;
  data::Dataset validation;
  // Training and validation together, where the tool itself held out a few of few tests: tracing
  // needs them all, and judges by leaving tests out itself.
  std::optional<data::Dataset> undivided;
  std::string leak; // calibrate::leak_note of the two
};

// Reads the files of [data]. Without validation files some experiments are held out. Throws
// InputError for files that cannot be used, for data.oracle with measured data, and where
// [export.inputs] names what is no state, history or column.
JobData load_job_data(const job::Job& job);

// The same without an error where most rows are implausible: what is then goes to `faults`.
JobData load_job_data(const job::Job& job, FaultList& implausible);

} // namespace frictab::run
