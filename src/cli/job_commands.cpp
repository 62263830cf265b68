// The commands that work on a job file alone: run, and most of its stages.
#include <cstdlib>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/colour.h"
#include "cli/job_commands.h"
#include "cli/print.h"
#include "core/error.h"
#include "core/os/interrupt.h"
#include "core/os/machine.h"
#include "core/text.h"
#include "run/plan.h"
#include "run/summary.h"

namespace frictab::cli {

void add_job(CLI::App& app, std::string& file, const std::string& description) {
  app.add_option("JOB", file, description + "; without it job.toml of this folder");
}

constexpr const char* usual_job = "job.toml";

bool has_job(const std::string& given) {
  std::error_code error;
  return !given.empty() || std::filesystem::exists(usual_job, error);
}

std::string job_file(const std::string& given) {
  if (has_job(given)) return given.empty() ? usual_job : given;
  throw InputError({}, "no JOB is given, and this folder has no job.toml",
                   "name a job file; frictab init --from FILES makes one from data files, frictab "
                   "twin DIR a synthetic campaign with one");
}

job::Job read_job(const std::string& file, const CommonOptions& common) {
  job::Job job = job::read_job(file, common.set);
  if (!common.output.empty()) {
    job.directory = common.output;
    job.command_line_options += " -o " + shell_word(common.output);
  }
  job.replaces_others = common.force;
  if (common.seed) {
    job.calibration.seed = *common.seed;
    job.command_line_options += fmt::format(" --seed {}", *common.seed);
  }
  for (const std::string& key : common.set)
    job.command_line_options += " --set " + shell_word(key);
  return job;
}

void print_notes(const run::Run& run, const CommonOptions& common) {
  if (run.data)
    for (const std::string& caution : run.data->training.cautions)
      note(common, "warning: " + caution);
  for (const std::string& line : run.notes)
    note(common, line);
}

static void show_summary(const std::string& text) {
  if (colours_on(stdout))
    print_out("{}", coloured(printable(text)));
  else
    show(text);
}

int print_plan(const job::Job& job, const std::string& command, const CommonOptions& common) {
  const run::Plan plan = run::plan_of(job, command);
  show(common.json ? run::plan_json(plan) : run::plan_text(plan));
  return plan.refused() ? 2 : 0;
}

int run_stage_command(const std::string& file, const CommonOptions& common,
                      const std::string& command,
                      const std::function<void(const run::Run&)>& afterwards) {
  job::Job job = read_job(job_file(file), common);
  if (common.dry_run) return print_plan(job, command, common);
  run::Run run(std::move(job));
  const auto print_checkpoint = [&] {
    if (const std::string kept = run.workspace.checkpoint_text(); !kept.empty()) note(common, kept);
  };
  try {
    const os::WhenInterrupted interrupted(print_checkpoint);
    if (command == "run")
      run_all(run);
    else
      run_stage(run, command);
    run.workspace.commit();
  } catch (...) {
    const int code = print_exception();
    print_checkpoint();
    return code;
  }
  print_notes(run, common);
  if (common.verbose && run.data)
    for (const std::string& line : run.data->training.notes)
      note(common, line);
  // A single stage prints all its findings; a whole run is brief, because it has a page.
  const words::Detail detail = common.verbose     ? words::Detail::verbose
                               : command == "run" ? words::Detail::brief
                                                  : words::Detail::full;
  if (common.json)
    show(run::summary_json(run));
  else
    show_summary(run::summary_text(run, detail));
  if (afterwards) afterwards(run);
  for (const std::string& miss : run.missed)
    print_error("error: {}\n", printable(miss));
  const bool verified = !run.verification || run.verification->passed();
  return verified && run.missed.empty() ? 0 : 1;
}

namespace {

Command job_command(int order, const char* name, const char* title, std::vector<Example> examples) {
  const auto declare = [](CLI::App& app, const CommonOptions& common) -> std::function<int()> {
    const auto file = std::make_shared<std::string>();
    add_job(app, *file);
    return [file, command = app.get_name(), &common] {
      return run_stage_command(*file, common, command);
    };
  };
  return {name, order, title, declare, stage_uses | uses_verbose, std::move(examples)};
}

const Registered<Command> run{[] {
  return job_command(
      2, "run", "Everything: calibrate, trace, tabulate, export, verify, report",
      {{"frictab run", "job.toml of this folder"},
       {"frictab run job.toml --dry-run", "what it would do and write"},
       {"frictab run job.toml -o loose --set table.tolerance_MPa=2", "another tolerance"}});
}};
const Registered<Command> calibrate{[] {
  return job_command(3, "calibrate", "Fit the friction laws and rank them on unseen experiments",
                     {{"frictab calibrate job.toml", "the ranking, calibration.json, models/"},
                      {"frictab calibrate job.toml --json", "the same as JSON, for a script"}});
}};
const Registered<Command> tabulate{[] {
  return job_command(
      4, "tabulate", "Sample the chosen law onto a grid made to the tolerance",
      {{"frictab tabulate job.toml", "tables/NAME.h5 of table.model"},
       {"frictab tabulate job.toml --set table.interpolation=cubic -o cubic", "other tables"}});
}};
const Registered<Command> report{[] {
  return job_command(8, "report",
                     "Write report.html, explore.html, report.md and summary.json from the results",
                     {{"frictab report job.toml", "out/report.html"}});
}};

} // namespace

} // namespace frictab::cli
