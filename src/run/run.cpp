// The table of all stages, and the functions that run one or all of them.
#include "run/run.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "core/error.h"
#include "core/large_work.h"
#include "core/progress.h"
#include "data/dataset.h"
#include "job/named_files.h"
#include "run/stage_functions.h"

namespace frictab::run {

std::string Stage::folder_or_file() const {
  const std::filesystem::path result = results.front();
  return (result.has_filename() ? result : result.parent_path()).string();
}

std::vector<std::string> Stage::writes() const {
  std::vector<std::string> all = results;
  all.insert(all.end(), pages.begin(), pages.end());
  return all;
}

// Order matters: a run goes through the table from top to bottom. A stage function takes its inputs
// from the Run, stores its values there and writes its files to the workspace.
const std::vector<Stage>& all_stages() {
  static const std::vector<Stage> all = {
      {.name = "calibrate",
       .sections = {"models", "calibration"},
       .results = {"calibration.json", "models/"},
       .pages = {"benchmark.md", "errors_by_experiment.csv"},
       .made_first = "there was no calibration: the laws were calibrated first",
       .is_there = [](const ResultDirectory& d, const StageRecord&) { return d.has_calibration(); },
       .load = load_calibration,
       .run = calibrate_laws},
      {.name = "trace",
       .needs = {"calibrate"},
       .sections = {"trace"},
       .results = {"trace.json"},
       .optional = true,
       .load = load_traces,
       .run = trace_laws},
      {.name = "tabulate",
       .needs = {"calibrate"},
       .sections = {"table"},
       .results = {"tables/"},
       .made_first = "there were no tables: they were made first",
       .is_there = [](const ResultDirectory& d, const StageRecord&) { return d.has_tables(); },
       .load = load_tables,
       .run = tabulate_laws},
      {.name = "export",
       .needs = {"calibrate", "tabulate"},
       .sections = {"export"},
       .results = {"export/"},
       .applies = [](const job::Job& job) { return !job.exports.targets.empty(); },
       .is_there =
           [](const ResultDirectory& d, const StageRecord& record) {
             return record.has("export") || !d.source_files().empty();
           },
       .load = [](Run&, std::string_view) {}, // verify loads the sources of each target when needed
       .run = export_sources},
      {.name = "verify",
       .needs = {"calibrate", "tabulate", "export"},
       .makes_missing = false,
       .sections = {"verify"},
       .results = {"verify.json", "verify.xml"},
       .load = load_verification,
       .run = verify_tables},
      // After all stages that tables and routines come from: none of them depends on it.
      {.name = "process",
       .needs = {"calibrate"},
       .sections = {"process"},
       .results = {"process.json"},
       .pages = {"process.html", "process_plan.csv"},
       .optional = true,
       .applies = [](const job::Job& job) { return !job.process.contact.empty(); },
       .run = judge_process},
      {.name = "report",
       .needs = {"calibrate", "tabulate"},
       .results = {"report.html", "explore.html", "report.md", "summary.json"},
       .run = write_report}};
  return all;
}

const Stage& stage_named(std::string_view name) {
  return *std::ranges::find(all_stages(), name, &Stage::name);
}

Run::Run(job::Job of_job) : job(std::move(of_job)), workspace(job) {
  if (!workspace.is_exclusive())
    notes.push_back(job.directory +
                    " is on a file system without locks: run one frictab at a time there");
}

std::string Run::path(const std::string& result) const {
  return (std::filesystem::path(job.directory) / result).string();
}

std::string Run::data_fingerprint() const {
  return data ? data::fingerprint(data->training, data->validation) : "";
}

void Run::finish(const std::string& stage) {
  workspace.record(stage, data_fingerprint());
  present.insert(stage);
  made.insert(stage);
}

bool Run::is_current(const std::string& stage, std::string_view wanted_by) {
  workspace.check_as_written(stage, stage + ".json");
  const std::string why = workspace.record().stale(stage, data_fingerprint());
  if (!why.empty())
    notes.push_back(fmt::format("{}.json is not in the {}: {}", stage, wanted_by, why));
  return why.empty();
}

namespace {

void load_data(Run& run) {
  if (run.data) return;
  const Progress progress("reading data", 0);
  run.data = large_work("putting the files of [data] together", 0, fewer_rows,
                        [&] { return load_job_data(run.job); });
}

// Puts the values of `stage` into the run: loads current results of an earlier run, or runs the
// stage if there are none. Throws InputError if those results are stale.
void make_present(Run& run, const Stage& stage, std::string_view wanted_by) {
  if (run.present.count(stage.name) > 0) return;
  if (!stage.is_there(run.workspace.earlier(), run.workspace.record())) {
    run.notes.push_back(stage.made_first);
    run_stage(run, stage.name);
    return;
  }
  run.workspace.check_fresh(stage, run.data_fingerprint());
  stage.load(run, wanted_by);
  run.present.insert(stage.name);
}

// Loads what a gate needs. Throws InputError with everything that is missing or stale.
void load_for_gate(Run& run, const std::vector<const Stage*>& needed, std::string_view gate) {
  FaultList faults;
  for (const Stage* stage : needed) {
    if (run.present.count(stage->name) > 0) continue;
    if (!stage->is_there(run.workspace.earlier(), run.workspace.record())) {
      faults.add({run.path(stage->folder_or_file()), 0, 0},
                 fmt::format("is missing, and `frictab {}` makes nothing", gate),
                 fmt::format("`frictab {} {}` makes it, `frictab run` everything", stage->name,
                             run.job.arguments()));
      continue;
    }
    try {
      run.workspace.check_fresh(*stage, run.data_fingerprint());
      if (!faults.empty()) continue; // what it needs is not loaded
      stage->load(run, gate);
      run.present.insert(stage->name);
    } catch (const InputError& error) {
      faults.add(error);
    }
  }
  faults.throw_if_any();
}

} // namespace

void run_stage(Run& run, std::string_view name) {
  const Stage& stage = stage_named(name);
  load_data(run);
  std::vector<const Stage*> needed;
  for (const std::string& one : stage.needs)
    if (stage_named(one).applies_to(run.job)) needed.push_back(&stage_named(one));
  if (!stage.makes_missing)
    load_for_gate(run, needed, name);
  else
    for (const Stage* one : needed)
      make_present(run, *one, name);
  stage.run(run);
}

void run_all(Run& run) {
  job::check_process_files(run.job); // before the stages that take long
  // Stages that the checkpoint covers load its results instead of computing them.
  run.workspace.resume();
  for (const Stage& stage : all_stages())
    run_stage(run, stage.name);
  time_forms(run);
}

} // namespace frictab::run
