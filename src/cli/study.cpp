// frictab study: many campaigns through the stages of one job.
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command.h"
#include "cli/print.h"
#include "core/error.h"
#include "core/shard.h"
#include "core/text.h"
#include "io/json.h"
#include "study/plan.h"
#include "study/report_study.h"
#include "study/run_study.h"

namespace frictab::cli::study_commands {

namespace {

constexpr const char* usual_study = "study.toml";

struct Options {
  std::string file, stage;
  std::string shard = "1/1";
  bool retry = false, failures_ok = false;
};

std::string study_file(const std::string& given) {
  std::error_code error;
  if (!given.empty() || std::filesystem::exists(usual_study, error))
    return given.empty() ? usual_study : given;
  throw InputError({}, "no STUDY is given, and this folder has no study.toml",
                   "name a study file; docs/study.md shows one");
}

study::Plan read_plan(const Options& options, const CommonOptions& common) {
  study::StudyOverrides overrides{common.output, {}, common.set};
  if (common.seed) overrides.set.push_back(fmt::format("calibration.seed={}", *common.seed));
  if (!options.stage.empty()) overrides.stage = study::stage_named(options.stage);
  study::Plan plan = study::plan_of(study::read_study(study_file(options.file), overrides));
  for (const std::string& line : plan.notes)
    note(common, "note: " + line);
  return plan;
}

int plan(const Options& options, const CommonOptions& common) {
  const study::Plan plan = read_plan(options, common);
  const study::Found found(plan.study.directory);
  show(common.json ? plan_json(plan, found) : plan_text(plan, found));
  return 0;
}

int status(const Options& options, const CommonOptions& common) {
  const study::Plan plan = read_plan(options, common);
  const study::Found found(plan.study.directory);
  show(common.json ? status_json(plan, found) : status_text(plan, found));
  return 0;
}

void tell(const study::RunCounts& counts, const CommonOptions& common) {
  if (common.json)
    show(io::json_text({{"schema", "frictab/study-run/1"},
                        {"computed", counts.computed},
                        {"there", counts.there},
                        {"elsewhere", counts.elsewhere},
                        {"failed", counts.failed},
                        {"missed", counts.missed}}));
  else
    show(fmt::format(
        "{} computed, {} were there, {} failed{}\n", thousands(counts.computed),
        thousands(counts.there + counts.elsewhere), thousands(counts.failed),
        counts.missed > 0 ? fmt::format(", {} missed a target", thousands(counts.missed)) : ""));
}

int run(const Options& options, const CommonOptions& common) {
  const Shard shard = read_shard(options.shard);
  const study::Plan plan = read_plan(options, common);
  const study::RunCounts counts = run_study(plan, {shard, options.retry});
  tell(counts, common);
  if (counts.failed > 0 && !options.failures_ok) {
    print_error("error: {} failed\n  hint: `frictab study status {}` says why; with --failures-ok "
                "they are left to the report\n",
                counts.failed == 1 ? "1 campaign" : thousands(counts.failed) + " campaigns",
                printable(plan.study.file));
    return counts.broken > 0 ? 3 : 2;
  }
  return counts.missed > 0 ? 1 : 0;
}

int report(const Options& options, const CommonOptions& common) {
  const study::Plan plan = read_plan(options, common);
  const study::Tally tally = report_study(plan);
  show(common.json ? report_json(plan, tally) : report_text(plan, tally));
  return 0;
}

int check(const Options& options, const CommonOptions& common) {
  const study::Plan plan = read_plan(options, common);
  const study::Found found(plan.study.directory);
  const std::vector<std::string> lines = differences_of(plan, found);
  const study::Counts counts = counts_of(plan, found);
  if (common.json)
    show(io::json_text({{"schema", "frictab/study-check/1"},
                        {"checked", counts.done + counts.damaged},
                        {"differences", lines}}));
  else
    show(fmt::format("{}{} results checked, {}\n", join(lines, "\n") + (lines.empty() ? "" : "\n"),
                     thousands(counts.done + counts.damaged),
                     lines.empty() ? "all as they were written" : "not all as they were written"));
  return lines.empty() ? 0 : 1;
}

// Declares "frictab study NAME STUDY" with the options that all of them have.
template <int (*command)(const Options&, const CommonOptions&), bool runs = false>
std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto options = std::make_shared<Options>();
  app.add_option("STUDY", options->file, "Study file (TOML); without it study.toml of this folder");
  app.add_option("--stage", options->stage, "The last stage, instead of the study's")
      ->check(CLI::IsMember({"calibrate", "trace", "run"}));
  if (runs) {
    app.add_option("--shard", options->shard,
                   "The i-th of n parts of the campaigns; each part may run anywhere")
        ->type_name("I/N");
    app.add_flag("--retry", options->retry, "Try again what failed by its job or data");
    app.add_flag("--failures-ok", options->failures_ok,
                 "Exit with 0 where campaigns failed: the report lists them");
  }
  return [options, &common] { return command(*options, common); };
}

constexpr unsigned study_uses =
    uses_output | uses_threads | uses_quiet | uses_json | uses_seed | uses_set | uses_progress;

const Registered<Command> group{[] {
  return Command{"study", 15, "Many campaigns through one job: plan, run, status, report",
                 nullptr, 0,  {{"frictab help study run", "options of a command below it"}}};
}};
const Registered<Command> plan_command{[] {
  return Command{"study plan",
                 16,
                 "Read the study and its data; every fault at once",
                 declare<plan>,
                 study_uses,
                 {{"frictab study plan", "study.toml of this folder"},
                  {"frictab study plan study.toml --json", "the key of every campaign"}}};
}};
const Registered<Command> run_command{[] {
  return Command{"study run",
                 17,
                 "Compute the campaigns that have no result yet",
                 declare<run, true>,
                 study_uses,
                 {{"frictab study run study.toml", "all of them, one after the other"},
                  {"frictab study run study.toml --shard 3/8 -j1", "a part, on one core"},
                  {"frictab study run study.toml --stage calibrate", "without tracing"}}};
}};
const Registered<Command> status_command{[] {
  return Command{"study status",
                 18,
                 "How many campaigns are done, failed or missing",
                 declare<status>,
                 study_uses,
                 {{"frictab study status study.toml", "with the first failures"},
                  {"frictab study status study.toml --json", "for a script"}}};
}};
const Registered<Command> check_command{[] {
  return Command{"study check",
                 19,
                 "Compare all results with the hashes they were stored with",
                 declare<check>,
                 study_uses,
                 {{"frictab study check study.toml", "exit 1 where something is off"}}};
}};
const Registered<Command> report_command{[] {
  return Command{"study report",
                 19,
                 "One table and one page of all campaigns that are done",
                 declare<report>,
                 study_uses,
                 {{"frictab study report study.toml", "campaigns.csv and report.html"},
                  {"frictab study report study.toml --json", "how often each law is best"}}};
}};

} // namespace

} // namespace frictab::cli::study_commands
