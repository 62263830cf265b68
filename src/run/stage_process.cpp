// Stage process: judges the laws in a simulation of the user's own.
#include <optional>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "data/append.h"
#include "data/load.h"
#include "data/load_condensed.h"
#include "job/named_files.h"
#include "process/process_json.h"
#include "report/process_page.h"
#include "run/stage_functions.h"
#include "words/process.h"
#include "words/render.h"

namespace frictab::run {

namespace {

using data::Dataset;

// All tests of a job's data, whichever part they are in.
Dataset all_tests(const JobData& data) {
  if (data.undivided) return *data.undivided;
  if (data.together) return *data.together;
  return &data.judged() == &data.training ? data.training
                                          : data::together(data.training, data.validation);
}

// The job's data with further tests to calibrate on.
JobData with_added(const JobData& data, const job::Job& job) {
  const std::size_t blocks = data::blocks_to_condense(job.data);
  data::ReadRequest request = job.data;
  request.training = job.process.add;
  const Dataset added = blocks > 0 ? data::load_condensed(job.process.add, request, blocks)
                                   : data::load_dataset(job.process.add, request);
  JobData more = data;
  more.training = data::together(data.training, added);
  if (data.undivided) more.undivided = data::together(*data.undivided, added);
  if (data.together) more.together = data::together(*data.together, added);
  return more;
}

std::vector<std::string> lines_of(const process::Process& found) {
  return words::as_json(words::process_in_short(found))["lines"];
}

} // namespace

void judge_process(Run& run) {
  // Without [process] in the job, results of `frictab process JOB CONTACT` stay.
  if (run.job.process.contact.empty()) return;
  job::check_process_files(run.job);
  run.workspace.remove_earlier("process_plan.csv"); // not written where no tests can be proposed
  const JobData& data = *run.data;
  const Dataset all = all_tests(data);
  // With the tests of process.add.
  std::optional<JobData> more;
  std::optional<calibrate::Calibration> again;
  std::optional<Dataset> all_more;
  with_rows_in_memory(data, [&] {
    const process::Tests tests{*run.calibration, data.training, data.judged(), all};
    std::optional<process::Tests> added;
    if (!run.job.process.add.empty()) {
      more = with_added(data, run.job);
      again = calibrate::calibrate(more->calibration_input(run.job));
      all_more = all_tests(*more);
      added.emplace(process::Tests{*again, more->training, more->judged(), *all_more});
    }
    run.process = process::judge_process(tests, added ? &*added : nullptr, run.job.process,
                                         calibrate::conventions_of(run.job.models, data.training));
  });
  const process::Process& found = *run.process;
  run.workspace.write("process.json", process::process_json(found, lines_of(found)));
  run.workspace.write("process.html",
                      report::process_html(found, all_more ? *all_more : all,
                                           again ? *again : *run.calibration, run.job.file));
  if (!found.proposed.tests.empty())
    run.workspace.write("process_plan.csv", process::plan_csv(found.proposed, all.experiments,
                                                              run.job.calibration.seed));
  run.finish("process");
}

} // namespace frictab::run
