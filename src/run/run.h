// One command on one job: the values that move from stage to stage, and the workspace they are
// taken from and written to.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "codegen/exporter.h"
#include "job/job.h"
#include "run/job_data.h"
#include "run/stage.h"
#include "run/workspace.h"
#include "table/table.h"
#include "trace/trace.h"
#include "verify/forms.h"
#include "verify/verify.h"

namespace frictab::run {

struct Run {
  explicit Run(job::Job job);
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  const job::Job job;
  Workspace workspace;
  std::vector<std::string> notes; // what a user should know

  // Values; empty until a stage has made them or taken them from an earlier run.
  std::set<std::string> present; // stages whose values are here
  std::optional<JobData> data;
  std::optional<calibrate::Calibration> calibration;
  std::vector<trace::Trace> traces;
  std::vector<table::Table> tables;
  std::map<std::string, verify::DriftRecord> drift_of_tables; // of those made here, by model name
  std::map<std::string, codegen::SourceBundle> sources;       // by directory
  std::optional<verify::Verification> verification;
  std::vector<verify::FormComparison> forms;
  std::vector<std::string> missed; // tables made here that drift further than allowed, in words

  std::string path(const std::string& result) const; // of a file in the output directory
  std::string data_fingerprint() const;              // empty where the data were not read
  // Marks a stage as finished, in stages.json and in the checkpoint.
  void finish(const std::string& stage);
};

// One stage, after those that it goes on from: taken from an earlier run where their results are
// there and current, made first where there are none. Throws InputError where they are stale.
void run_stage(Run& run, std::string_view stage);

// Every stage, from what a run that did not end had finished; then the forms are timed. Nothing
// appears in the output directory before run.workspace.commit().
void run_all(Run& run);

} // namespace frictab::run
