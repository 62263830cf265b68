// frictab status JOB: results that exist, those that are stale, and the next command.
#include <algorithm>
#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/job_commands.h"
#include "core/os/files.h"
#include "io/atomic_file.h"
#include "io/json.h"
#include "run/job_data.h"
#include "run/stage.h"
#include "run/stage_record.h"

namespace frictab::cli::status_command {

struct StageStatus {
  std::string name, state, why; // done | stale | missing
};

// Returns the first law that table.model names and that has no table.
std::string law_without_table(const job::Job& job) {
  std::vector<std::string> tables;
  for (const std::filesystem::path& file : os::entries_of(job.directory + "/tables"))
    tables.push_back(file.stem().string());
  for (const std::string& law : job.table.model)
    if (std::ranges::none_of(tables, [&](const std::string& table) {
          return table == law || table.starts_with(law + "_q"); // table of a quantile
        }))
      return law;
  return "";
}

// Names a file that differs from its record. verify.xml is also written alone, by a verification
// that met a fault (run/results.h).
std::string change_of(const run::StageRecord& stages, const std::string& stage) {
  const std::string changed = stages.changed_file(stage);
  if (changed.empty()) return "";
  return changed == "verify.xml" ? "the last `verify` met the fault that verify.xml names"
                                 : changed + " was changed since";
}

std::vector<StageStatus> status_of(const job::Job& job) {
  io::finish_interrupted(job.directory);
  const run::JobData data = run::load_job_data(job);
  const run::StageRecord stages(job, job.directory);
  const std::string key = data::fingerprint(data.training, data.validation);
  std::vector<StageStatus> out;
  for (const run::Stage& stage : run::all_stages()) {
    if (!stage.is_recorded() || (stage.optional && !stage.applies_to(job))) continue;
    const std::string& name = stage.name;
    StageStatus status{name, "missing", ""};
    if (stages.has(name)) {
      status.why = stages.stale(name, key);
      if (name == "tabulate" && status.why.empty() && job.table.names_laws())
        if (const std::string law = law_without_table(job); !law.empty())
          status.why = "there is no table of " + law;
      for (const StageStatus& before : out)
        if (status.why.empty() && before.state == "stale")
          status.why = fmt::format("`{}` is stale", before.name);
      if (status.why.empty()) status.why = change_of(stages, name);
      status.state = status.why.empty() ? "done" : "stale";
    }
    out.push_back(status);
  }
  return out;
}

// Returns the command that makes everything current: the stage, or `run` if several stages are
// missing or stale. A missing optional stage (trace) does not count.
std::string next_command(const std::vector<StageStatus>& all, const job::Job& job) {
  std::vector<std::string> open;
  for (const StageStatus& one : all)
    if (one.state == "stale" || (one.state == "missing" && !run::stage_named(one.name).optional))
      open.push_back(one.name);
  if (open.empty()) return "";
  return fmt::format("frictab {} {}", open.size() == 1 ? open.front() : "run", job.arguments());
}

// Compares every file with the hash that its stage stored.
int check(const job::Job& job, const CommonOptions& common) {
  io::finish_interrupted(job.directory);
  const std::vector<std::string> differences = run::differences_in(job.directory);
  if (common.json)
    show(io::json_text({{"directory", job.directory}, {"differences", differences}}));
  for (const std::string& line : differences)
    if (!common.json) show(line + "\n");
  if (!common.json && differences.empty()) show("all files are as they were written\n");
  return differences.empty() ? 0 : 1;
}

int run(const std::string& file, const CommonOptions& common) {
  const job::Job job = read_job(file, common);
  const std::vector<StageStatus> all = status_of(job);
  const std::string next = next_command(all, job);
  if (common.json) {
    nlohmann::ordered_json json = {{"directory", job.directory}, {"stages", {}}, {"next", next}};
    for (const StageStatus& one : all)
      json["stages"].push_back({{"stage", one.name}, {"state", one.state}, {"why", one.why}});
    show(io::json_text(json));
    return 0;
  }
  for (const StageStatus& one : all)
    show(fmt::format("{:<10} {}{}\n", one.name, one.state, one.why.empty() ? "" : ": " + one.why));
  show((next.empty() ? "nothing is left to do" : "next: " + next) + "\n");
  return 0;
}

std::function<int()> declare(CLI::App& app, const CommonOptions& common) {
  const auto file = std::make_shared<std::string>();
  const auto checks = std::make_shared<bool>(false);
  add_job(app, *file);
  app.add_flag("--check", *checks,
               "Compare all files with the hashes they were stored with; exit 1 where one differs");
  return [file, checks, &common] {
    return *checks ? check(read_job(job_file(*file), common), common)
                   : run(job_file(*file), common);
  };
}

const Registered<Command> registered{[] {
  return Command{"status",
                 9,
                 "Results of a job that exist, those out of date, and the next step",
                 declare,
                 uses_output | uses_threads | uses_json | uses_seed | uses_set,
                 {{"frictab status", "of job.toml in this folder"},
                  {"frictab status --check", "are all files as they were written?"},
                  {"frictab status job.toml --json", "for a script"}}};
}};

} // namespace frictab::cli::status_command
