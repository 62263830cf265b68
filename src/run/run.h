// One command on one job. Run holds the job, the workspace (the output directory) and the values
// that move from stage to stage:
//
//   data -> calibration -> traces -> tables -> sources -> verification -> process -> report
//
// The whole program flow is in three files: this one has the values, run/stage.h defines a stage,
// and run.cpp has the table of stages and the loop over them. Each stage's work is in its
// stage_*.cpp.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "codegen/exporter.h"
#include "job/job.h"
#include "process/process.h"
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
  std::vector<std::string> notes; // messages for the user

  // Stages whose values below are final, including those known to have none.
  std::set<std::string> present;
  std::set<std::string> made; // those that this command ran; the others were loaded

  // Values, in the order in which they are filled, each with its stage. A value is empty until that
  // stage has computed it or loaded it from an earlier run.
  std::optional<JobData> data;                       // read before the first stage
  std::optional<calibrate::Calibration> calibration; // calibrate; trace adds its laws
  std::vector<trace::Trace> traces;                  // trace
  std::vector<table::Table> tables;                  // tabulate
  // Drift of tables made by tabulate in this run, by model name; verify reuses it.
  std::map<std::string, verify::DriftRecord> drift_of_tables;
  std::map<std::string, codegen::SourceBundle> sources; // export, or loaded by verify; by directory
  std::optional<verify::Verification> verification;     // verify
  std::optional<process::Process> process;              // process, if the job has one
  std::vector<verify::FormComparison> forms;            // time_forms; run_all only
  // One message of tabulate per new table that drifts further than allowed.
  std::vector<std::string> missed;

  std::string path(const std::string& result) const; // of a file in the output directory
  std::string data_fingerprint() const;              // empty if no data were read
  // Records a finished stage for stages.json and adds it to `present`.
  void finish(const std::string& stage);
  // Returns true if STAGE.json of an earlier run can be taken; else a note gives the reason. Throws
  // InputError if the file was changed.
  bool is_current(const std::string& stage, std::string_view wanted_by);
};

// Runs one stage. First puts the values of the stages it needs into the run: loads current results
// of an earlier run, or runs those stages if there are none; a gate (Stage::makes_missing) runs
// none. Throws InputError if the earlier results are stale, or missing for a gate.
void run_stage(Run& run, std::string_view stage);

// Runs every stage, resuming from the checkpoint of a run that did not end, then times the forms.
// The output directory does not change before run.workspace.commit().
void run_all(Run& run);

} // namespace frictab::run
