// frictab data JOB: the data test by test as they were read, before anything is fitted.
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "calibrate/calibration.h"
#include "cli/job_commands.h"
#include "cli/print.h"
#include "core/text.h"
#include "data/first_lines.h"
#include "data/write_dataset.h"
#include "report/data_page.h"
#include "run/data_summary.h"
#include "run/results.h"

namespace frictab::cli::data_command {

struct Options {
  std::string job;
  std::string write; // csv or hdf5
};

std::vector<std::string> texts_of(const FaultList& faults) {
  std::vector<std::string> out;
  for (const Fault& fault : faults.all())
    out.push_back(fault.what + "; " + fault.hint);
  return out;
}

// Shows the first lines of the first file that is at fault as a whole, not by a cell.
run::JobData loaded(const job::Job& job, FaultList& implausible) {
  try {
    return run::load_job_data(job, implausible);
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults()) {
      const bool is_cell = fault.place.column > 0;
      const std::string lines = is_cell ? "" : data::first_lines(fault.place.file, job.data);
      if (lines.empty()) continue;
      print_error("{} begins so:\n{}", printable(fault.place.file), lines);
      break;
    }
    throw;
  }
}

// Shows and writes everything even if most rows are implausible; the error comes after that.
int run(const Options& options, const CommonOptions& common) {
  job::Job job = read_job(job_file(options.job), common);
  if (!options.write.empty()) job.data.condense = {0}; // writing needs single rows
  FaultList implausible;
  const run::JobData data = loaded(job, implausible);
  io::OutputFiles files(job.directory);
  files.write("data.html",
              report::data_html({job.file, calibrate::is_synthetic(data.training), data.judged_by,
                                 data.training, data.validation, texts_of(implausible)}));
  if (options.write == "csv") files.write("data.csv", data::csv_text(run::canonical(data)));
  if (options.write == "hdf5")
    data::write_hdf5_columns(run::canonical(data), files.stage("data.h5"));
  const std::vector<std::string> written = files.paths();
  run::StageRecord stages(job, job.directory);
  run::commit_results(job, stages, files);
  show(common.json ? run::data_json(data) : run::data_text(data));
  std::fflush(stdout); // stdout before the line to stderr
  note(common, fmt::format("wrote {} to {}", join(written, ", "), job.directory));
  implausible.throw_if_any();
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  add_job(app, options->job);
  app.add_option("--write", options->write,
                 "also write the data in canonical names and units: data.csv or data.h5")
      ->check(CLI::IsMember({"csv", "hdf5"}))
      ->expected(0, 1)
      ->default_str("csv");
  return [options, &common] { return run(*options, common); };
}

const Registered<Command> registered{[] {
  return Command{
      "data",
      2,
      "Show what was read: each test, what was converted, computed, left out",
      declare,
      uses_output | uses_force | uses_threads | uses_quiet | uses_json | uses_seed | uses_set,
      {{"frictab data job.toml", "a line per test; data.html has all strokes"},
       {"frictab data job.toml --write hdf5", "and the data in canonical names and units"}}};
}};

} // namespace frictab::cli::data_command
