// Plans the stages of a command: its own, and before it the stages that it needs.
#include "run/plan.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "calibrate/calibration.h"
#include "codegen/exporter.h"
#include "core/error.h"
#include "core/text.h"
#include "data/dataset.h"
#include "io/json.h"
#include "run/checkpoint.h"
#include "run/job_data.h"
#include "run/result_directory.h"
#include "run/results.h"
#include "run/stage.h"
#include "run/stage_record.h"

namespace frictab::run {

namespace {

using Action = PlannedStage::Action;

const char* action_name(Action action) {
  switch (action) {
  case Action::run:
    return "run";
  case Action::keep:
    return "keep";
  case Action::refuse:
    break;
  }
  return "refuse";
}

class Planner {
public:
  explicit Planner(const job::Job& job)
      : job_(job), data_(load_job_data(job)),
        key_(data::fingerprint(data_.training, data_.validation)), earlier_(job, job.directory),
        stages_(job, job.directory), laws_(calibrate::names_of_laws(data_.calibration_input(job))) {
  }

  Plan plan(const std::string& command) const {
    check_directory(job_, stages_);
    Plan plan{job_.directory, {}};
    if (command == "run") {
      for (const Stage& stage : all_stages())
        plan.stages.push_back(stage_of_run(stage.name));
    } else {
      for (const std::string& stage : stage_named(command).needs)
        plan.stages.push_back(stage_before(stage, command));
      plan.stages.push_back({command, Action::run, "", writes(command)});
    }
    std::erase_if(plan.stages,
                  [&](const PlannedStage& one) { return !stage_named(one.name).applies_to(job_); });
    return plan;
  }

private:
  // Plans a stage of `frictab run`, which rebuilds everything except what its checkpoint has.
  PlannedStage stage_of_run(const std::string& stage) const {
    PlannedStage out{stage, Action::run, "", writes(stage)};
    const Checkpoint kept(job_);
    const bool finished = stage == "calibrate" ? kept.has_calibration(key_)
                                               : stage == "trace" && kept.has_calibration(key_) &&
                                                     kept.has("trace", key_);
    if (finished) {
      out.action = Action::keep;
      out.why = "of a run that did not end";
    }
    return out;
  }

  PlannedStage stage_before(const std::string& stage, const std::string& command) const {
    const bool is_there = stage_named(stage).is_there(earlier_, stages_);
    if (!is_there && !stage_named(command).makes_missing)
      return {stage,
              Action::refuse,
              fmt::format(
                  "missing, and `{}` makes nothing: `frictab {} {}` makes it, `frictab run` all",
                  command, stage, job_.arguments()),
              {}};
    if (!is_there) return {stage, Action::run, "there is none: it is made first", writes(stage)};
    const std::string why = stages_.stale(stage, key_);
    if (why.empty()) return {stage, Action::keep, "", {}};
    const std::string mend = fmt::format("{}; `frictab {} {}` rebuilds it, `frictab run` all", why,
                                         stage, job_.arguments());
    return {stage, Action::refuse, "stale, so `" + command + "` stops: " + mend, {}};
  }

  // Lists the files that a stage writes, also those within "models/", "tables/" and "export/".
  std::vector<std::string> writes(const std::string& stage) const {
    if (stage == "trace") return {"trace.json", "models/NAME_traced.json where an effect is added"};
    std::vector<std::string> files, in_folders;
    for (const std::string& path : stage_named(stage).writes()) {
      if (!path.ends_with("/")) files.push_back(path);
      for (const std::string& file : files_in(path))
        in_folders.push_back(path + file);
    }
    files.insert(files.end(), in_folders.begin(), in_folders.end());
    return files;
  }

  std::vector<std::string> files_in(const std::string& folder) const {
    std::vector<std::string> files;
    if (folder == "models/")
      for (const std::string& law : laws_)
        files.push_back(law + ".json");
    if (folder == "tables/") files = table_files();
    if (folder == "export/")
      for (const codegen::Exporter* target : codegen::exporters_named(job_.exports.targets))
        files.push_back(target->name + "/");
    return files;
  }

  std::vector<std::string> table_files() const {
    std::vector<std::string> files;
    const auto add = [&](const std::string& law) {
      for (const double quantile : job_.table.quantile)
        files.push_back(fmt::format(
            "{}{}.h5", law, quantile == 0.5 ? "" : fmt::format(" at quantile {}", quantile)));
    };
    for (const std::string& name : job_.table.model) {
      if (name == "best")
        add("BEST_LAW");
      else if (name == "recommended")
        add("RECOMMENDED_LAW");
      else if (name != "all")
        add(name);
      else
        for (const std::string& law : laws_)
          add(law);
    }
    return files;
  }

  const job::Job& job_;
  JobData data_;
  std::string key_;
  ResultDirectory earlier_;
  StageRecord stages_;
  std::vector<std::string> laws_;
};

} // namespace

bool Plan::refused() const {
  return std::ranges::any_of(stages,
                             [](const PlannedStage& one) { return one.action == Action::refuse; });
}

Plan plan_of(const job::Job& job, const std::string& command) {
  return Planner(job).plan(command);
}

std::string plan_text(const Plan& plan) {
  std::string text;
  for (const PlannedStage& stage : plan.stages) {
    text += fmt::format("{:<7} {}{}\n", action_name(stage.action), stage.name,
                        stage.why.empty() ? "" : " (" + stage.why + ")");
    for (const std::string& file : stage.writes)
      text += fmt::format("          {}\n", file);
  }
  return text + (plan.refused()
                     ? "stops before anything is written\n"
                     : "into " + plan.directory + ", with stages.json; nothing was written now\n");
}

std::string plan_json(const Plan& plan) {
  nlohmann::ordered_json json = {{"directory", plan.directory}, {"stages", {}}};
  for (const PlannedStage& stage : plan.stages)
    json["stages"].push_back({{"stage", stage.name},
                              {"action", action_name(stage.action)},
                              {"why", stage.why},
                              {"writes", stage.writes}});
  return io::json_text(json);
}

} // namespace frictab::run
