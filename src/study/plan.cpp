// Computes the keys of all campaigns and finds their results.
#include "study/plan.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/os/files.h"
#include "core/parallel.h"
#include "core/progress.h"
#include "core/text.h"
#include "core/version.h"
#include "io/json.h"
#include "study/keys.h"
#include "study/result_store.h"
#include "study/toml_values.h"

namespace frictab::study {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Lists groups of identical campaigns, in the order of the campaigns.
static std::vector<std::string> same_campaigns(const Plan& plan) {
  std::vector<std::size_t> order(plan.keys.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, [&](std::size_t a, std::size_t b) { return plan.keys[a] < plan.keys[b]; });
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 1; i < order.size(); ++i)
    if (plan.keys[order[i]] == plan.keys[order[i - 1]]) pairs.emplace_back(order[i], order[i - 1]);
  std::ranges::sort(pairs);
  std::vector<std::string> notes;
  for (const auto& [later, earlier] : pairs)
    notes.push_back(fmt::format(
        "campaigns '{}' and '{}' have the same job and the same data: one result is for both",
        plan.study.campaigns[earlier].name, plan.study.campaigns[later].name));
  return notes;
}

Plan plan_of(Study study) {
  Plan plan{std::move(study), {}, {}};
  const std::vector<Campaign>& campaigns = plan.study.campaigns;
  plan.keys.resize(campaigns.size());
  std::vector<std::optional<InputError>> errors(campaigns.size());
  const Progress progress("hashing data", campaigns.size());
  parallel_for(campaigns.size(), [&](std::size_t i) {
    try {
      WatchedFiles files; // watched from the time when they are read
      plan.keys[i] = key_of(plan.study, campaigns[i], files);
    } catch (const InputError& error) {
      errors[i] = error;
    }
    progress.tick();
  });
  FaultList faults;
  for (std::size_t i = 0; i < errors.size(); ++i)
    if (errors[i])
      add_at(campaigns[i].place, *errors[i], faults,
             fmt::format("campaign '{}': ", campaigns[i].name));
  faults.throw_if_any();
  plan.notes = same_campaigns(plan);
  return plan;
}

const char* state_name(State state) {
  constexpr const char* names[] = {"missing", "done", "failed", "damaged"};
  return names[static_cast<std::size_t>(state)];
}

// The first difference of each result from what was written; empty: none.
static std::vector<std::string> first_differences(const std::string& directory,
                                                  const std::vector<std::uint64_t>& keys) {
  std::vector<std::string> found(keys.size());
  parallel_for(keys.size(), [&](std::size_t i) {
    const auto all = differences_of_result(directory, keys[i]);
    if (!all.empty()) found[i] = all.front();
  });
  return found;
}

Found::Found(const std::string& directory) {
  std::vector<std::uint64_t> results, failures;
  for (const fs::path& path : os::entries_of(fs::path(directory) / results_folder)) {
    const std::string name = path.filename().string();
    if (const auto key = read_key(name)) {
      results.push_back(*key);
    } else if (name.starts_with(".") && name.size() > 17) { // .KEY.XXXXXX
      ++unfinished;
      if (const auto open = read_key(std::string_view(name).substr(1, 16))) begun.insert(*open);
    }
  }
  for (const fs::path& path : os::entries_of(fs::path(directory) / failures_folder))
    if (const auto key = read_key(path.stem().string())) failures.push_back(*key);
  const std::vector<std::string> wrong = first_differences(directory, results);
  for (std::size_t i = 0; i < results.size(); ++i)
    if (wrong[i].empty())
      done.insert(results[i]);
    else
      damaged.emplace(results[i], wrong[i]);
  for (const std::uint64_t key : failures)
    try {
      read_failure(directory, key);
      failed.insert(key);
    } catch (const InputError& error) {
      damaged.emplace(key, error.faults().front().what);
    }
}

State Found::state(std::uint64_t key) const {
  if (done.count(key) > 0) return State::done;
  if (damaged.count(key) > 0) return State::damaged;
  return failed.count(key) > 0 ? State::failed : State::missing;
}

Counts counts_of(const Plan& plan, const Found& found) {
  Counts counts;
  for (const std::uint64_t key : plan.keys) {
    const State state = found.state(key);
    counts.done += state == State::done;
    counts.failed += state == State::failed;
    counts.missing += state == State::missing;
    counts.damaged += state == State::damaged;
  }
  return counts;
}

std::string counts_text(const Counts& counts) {
  std::string text = fmt::format("{} done, {} failed, {} missing", thousands(counts.done),
                                 thousands(counts.failed), thousands(counts.missing));
  if (counts.damaged > 0) text += fmt::format(", {} damaged", thousands(counts.damaged));
  return text;
}

namespace {

std::string head_text(const Plan& plan, const Found& found) {
  const Study& study = plan.study;
  return fmt::format("{}: {} campaigns, each {} stage {}{}\n{}\n", study.file,
                     thousands(study.campaigns.size()),
                     study.stage == LastStage::run ? "through every" : "up to the",
                     study.stage == LastStage::run ? "of a run" : stage_name(study.stage),
                     study.is_synthetic() ? " - SYNTHETIC data among them" : "",
                     counts_text(counts_of(plan, found)));
}

std::string next_text(const Plan& plan, const Found& found) {
  const Counts counts = counts_of(plan, found);
  const bool open = counts.missing + counts.damaged > 0;
  return fmt::format("next: frictab study {} {}{}\n", open ? "run" : "report",
                     shell_word(plan.study.file), plan.study.command_line_options);
}

Json head_json(const Plan& plan, const Found& found) {
  const Counts counts = counts_of(plan, found);
  return {{"study", plan.study.file},
          {"directory", plan.study.directory},
          {"stage", stage_name(plan.study.stage)},
          {"tool_version", tool_version()},
          {"synthetic_data", plan.study.is_synthetic()},
          {"campaigns", plan.keys.size()},
          {"done", counts.done},
          {"failed", counts.failed},
          {"missing", counts.missing},
          {"damaged", counts.damaged}};
}

} // namespace

std::string plan_text(const Plan& plan, const Found& found) {
  std::string text = head_text(plan, found);
  const std::vector<Campaign>& campaigns = plan.study.campaigns;
  for (std::size_t i = 0; i < campaigns.size() && i < most_listed; ++i)
    text += fmt::format("  {}  {:<7}  {}\n", key_text(plan.keys[i]),
                        state_name(found.state(plan.keys[i])), campaigns[i].name);
  if (campaigns.size() > most_listed)
    text +=
        fmt::format("  and {} more; --json has all\n", thousands(campaigns.size() - most_listed));
  return text + next_text(plan, found);
}

std::string plan_json(const Plan& plan, const Found& found) {
  Json json = head_json(plan, found);
  json["schema"] = "frictab/study-plan/1";
  json["notes"] = plan.notes;
  Json& list = json["keys"] = Json::array();
  for (std::size_t i = 0; i < plan.keys.size(); ++i)
    list.push_back({{"campaign", plan.study.campaigns[i].name},
                    {"key", key_text(plan.keys[i])},
                    {"state", state_name(found.state(plan.keys[i]))}});
  return io::json_text(json);
}

namespace {

// Returns the first campaigns in this state, failed or damaged, with what is wrong.
std::vector<Failure> first_in(State state, const Plan& plan, const Found& found) {
  std::vector<Failure> first;
  for (std::size_t i = 0; i < plan.keys.size() && first.size() < most_listed; ++i)
    if (const std::uint64_t key = plan.keys[i]; found.state(key) == state) {
      first.push_back(state == State::failed ? read_failure(plan.study.directory, key)
                                             : Failure{"", found.damaged.at(key)});
      first.back().campaign = plan.study.campaigns[i].name;
    }
  return first;
}

// A damaged record of a failure is one line, without a folder.
std::vector<std::string> damages_of(const std::string& directory, std::uint64_t key,
                                    const std::string& damage) {
  if (!fs::exists(result_directory(directory, key)))
    return {fmt::format("{}/{}.json: {}", failures_folder, key_text(key), damage)};
  std::vector<std::string> lines = differences_of_result(directory, key);
  for (std::string& line : lines)
    line = fmt::format("{}/{}/{}", results_folder, key_text(key), line);
  return lines;
}

} // namespace

std::string status_text(const Plan& plan, const Found& found) {
  std::string text = head_text(plan, found);
  if (found.unfinished > 0)
    text += fmt::format("{} working directories: runs that go on, or were killed\n",
                        thousands(found.unfinished));
  for (const Failure& failure : first_in(State::failed, plan, found))
    text += fmt::format("failed: {}: {}\n", failure.campaign, failure.message);
  for (const Failure& damage : first_in(State::damaged, plan, found))
    text += fmt::format("damaged: {}: {}\n", damage.campaign, damage.message);
  return text + next_text(plan, found);
}

std::string status_json(const Plan& plan, const Found& found) {
  Json json = head_json(plan, found);
  json["schema"] = "frictab/study-status/1";
  json["working_directories"] = found.unfinished;
  json["first_failures"] = Json::array();
  for (const Failure& failure : first_in(State::failed, plan, found))
    json["first_failures"].push_back({{"campaign", failure.campaign},
                                      {"by_input", failure.by_input},
                                      {"message", failure.message}});
  json["first_damaged"] = Json::array();
  for (const Failure& damage : first_in(State::damaged, plan, found))
    json["first_damaged"].push_back({{"campaign", damage.campaign}, {"message", damage.message}});
  return io::json_text(json);
}

std::vector<std::string> differences_of(const Plan& plan, const Found& found) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < plan.keys.size(); ++i)
    if (const std::uint64_t key = plan.keys[i]; found.state(key) == State::damaged)
      for (const std::string& line : damages_of(plan.study.directory, key, found.damaged.at(key)))
        lines.push_back(fmt::format("campaign {}: {}", plan.study.campaigns[i].name, line));
  return lines;
}

} // namespace frictab::study
