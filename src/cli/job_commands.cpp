// The commands that work on a job file alone: run, and most of its stages.
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/job_commands.h"
#include "core/interrupt.h"
#include "core/text.h"
#include "run/summary.h"

namespace frictab::cli {

job::Job read_job(const std::string& file, const CommonOptions& common) {
  job::Job job = job::read_job(file, common.set);
  if (!common.output.empty()) job.directory = common.output;
  if (common.seed) job.calibration.seed = *common.seed;
  return job;
}

void tell_notes(const run::Pipeline& pipeline, const CommonOptions& common) {
  if (const auto& data = pipeline.data(); data && !data->leak.empty())
    note(common, "warning: " + data->leak);
  for (const std::string& line : pipeline.notes())
    note(common, line);
}

int run_stages(const std::string& file, const CommonOptions& common, const Stages& stages) {
  run::Pipeline pipeline(read_job(file, common));
  const auto tell_kept = [&] {
    if (const std::string kept = pipeline.kept_text(); !kept.empty()) note(common, kept);
  };
  try {
    const WhenInterrupted interrupted(tell_kept);
    stages(pipeline);
    pipeline.commit();
  } catch (...) {
    const int code = tell_error();
    tell_kept();
    return code;
  }
  tell_notes(pipeline, common);
  if (common.verbose && pipeline.data())
    for (const std::string& line : pipeline.data()->training.notes)
      note(common, line);
  show(common.json ? run::summary_json(pipeline) : run::summary_text(pipeline));
  for (const std::string& miss : pipeline.missed())
    fmt::print(stderr, "error: {}\n", printable(miss));
  const bool verified = !pipeline.verification() || pipeline.verification()->passed();
  return verified && pipeline.missed().empty() ? 0 : 1;
}

namespace {

// Declares "frictab NAME JOB": runs the stages, commits, prints the summary.
std::function<int()> declare(CLI::App& app, const CommonOptions& common, Stages stages) {
  const auto file = std::make_shared<std::string>();
  app.add_option("JOB", *file, "Job file (TOML)")->required();
  return [file, &common, stages] { return run_stages(*file, common, stages); };
}

void all_stages(run::Pipeline& p) {
  p.go_on();
  p.calibrate();
  p.trace();
  p.check_sizes();
  p.tabulate();
  p.generate();
  p.verify();
  p.report();
  p.compare_forms();
}

Command stage(int order, const char* name, const char* title,
              std::function<int()> (*declared)(CLI::App&, const CommonOptions&)) {
  Command command;
  command.name = name;
  command.order = order;
  command.title = title;
  command.declare = declared;
  return command;
}

const Registered<Command> run{[] {
  return stage(
      2, "run", "Everything: calibrate, trace, tabulate, export, verify, report",
      [](CLI::App& app, const CommonOptions& common) { return declare(app, common, all_stages); });
}};
const Registered<Command> calibrate{[] {
  return stage(3, "calibrate", "Fit the friction laws and rank them on unseen experiments",
               [](CLI::App& app, const CommonOptions& common) {
                 return declare(app, common, [](run::Pipeline& p) { p.calibrate(); });
               });
}};
const Registered<Command> tabulate{[] {
  return stage(4, "tabulate", "Sample the chosen law onto a grid made to the tolerance",
               [](CLI::App& app, const CommonOptions& common) {
                 return declare(app, common, [](run::Pipeline& p) { p.tabulate(); });
               });
}};
const Registered<Command> report{[] {
  return stage(8, "report", "Write report.html from the results so far",
               [](CLI::App& app, const CommonOptions& common) {
                 return declare(app, common, [](run::Pipeline& p) { p.report(); });
               });
}};

} // namespace

} // namespace frictab::cli
