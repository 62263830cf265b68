// Runs campaigns through the stages of a job, each in its own directory.
#include "study/run_study.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <new>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "core/hash.h"
#include "core/large_work.h"
#include "core/os/files.h"
#include "core/progress.h"
#include "core/text.h"
#include "data/write_dataset.h"
#include "io/atomic_file.h"
#include "io/file_streams.h"
#include "run/run.h"
#include "study/keys.h"
#include "study/result.h"
#include "study/result_store.h"

namespace frictab::study {

namespace fs = std::filesystem;

namespace {

// Folder of a twin's data, which are not kept because its seed reproduces them.
constexpr const char* twin_folder = "twin";

std::vector<std::string> write_part(const twin::TwinPart& part, const std::string& name,
                                    const fs::path& folder) {
  if (part.data.rows() == 0) return {};
  const fs::path file = fs::absolute(folder / name);
  io::write_file(file, data::csv_text(part.data));
  return {file.string()};
}

void write_twin(const Study& study, const TwinSeed& which, const fs::path& folder, job::Job& job) {
  twin::TwinOptions options = study.twins[which.block].options;
  options.seed = which.seed;
  const twin::Twin twin = twin::make_twin(options);
  fs::create_directory(folder);
  job.data.training = write_part(twin.training, "training.csv", folder);
  job.data.validation = write_part(twin.validation, "validation.csv", folder);
}

// Compares the laws before the laws with effects are added.
CampaignResult run_campaign(job::Job job, LastStage last) {
  run::Run run(std::move(job));
  run_stage(run, "calibrate");
  CampaignResult result = result_of(*run.calibration, *run.data);
  if (last != LastStage::calibrate) {
    run_stage(run, "trace");
    add_effects(result, run.traces);
  }
  if (last == LastStage::run)
    for (const char* stage : {"tabulate", "export", "verify", "report"})
      run_stage(run, stage);
  result.missed = run.missed;
  run.workspace.commit();
  return result;
}

// Returns the first campaign of each key of this shard. Keys are dealt out in their own order,
// which is independent of the study's: every shard gets as many (to within one), and none gets all
// large campaigns because every n-th is large.
std::vector<std::size_t> campaigns_of(const Shard& shard, const std::vector<std::uint64_t>& keys) {
  std::map<std::uint64_t, std::size_t> first;
  for (std::size_t i = 0; i < keys.size(); ++i)
    first.emplace(keys[i], i);
  std::vector<std::size_t> out;
  std::uint64_t place = 0;
  for (const auto& [key, campaign] : first)
    if (shard.has(place++)) out.push_back(campaign);
  std::ranges::sort(out);
  return out;
}

class StudyRun {
public:
  StudyRun(const Plan& plan, const RunOptions& options)
      : plan_(plan), options_(options), directory_(plan.study.directory), found_(directory_) {}

  RunCounts run() {
    std::vector<std::size_t> now, last;
    for (const std::size_t i : campaigns_of(options_.shard, plan_.keys))
      (found_.begun.count(plan_.keys[i]) > 0 ? last : now).push_back(i);
    // Campaigns that ended another process may end this one, so they come last.
    now.insert(now.end(), last.begin(), last.end());
    const Progress progress("campaigns", now.size());
    for (const std::size_t i : now) {
      take(i);
      progress.tick();
    }
    return counts_;
  }

private:
  void take(std::size_t i) {
    const std::uint64_t key = plan_.keys[i];
    const State state = found_.state(key);
    const bool came_since =
        state != State::damaged && fs::exists(result_directory(directory_, key));
    if (state == State::done || came_since)
      ++counts_.there;
    else if (fails_again(key))
      ++counts_.failed;
    else
      compute_or_fail(i);
  }

  bool fails_again(std::uint64_t key) const {
    return !options_.retry && found_.state(key) == State::failed &&
           read_failure(directory_, key).by_input;
  }

  void compute_or_fail(std::size_t i) {
    try {
      compute(i);
    } catch (const InputError& error) {
      fail(i, error.what(), true);
    } catch (const OutOfMemory& error) {
      fail(i, error.what(), false);
    } catch (const std::bad_alloc&) {
      fail(i, "out of memory", false);
    } catch (const std::exception& error) {
      fail(i, error.what(), false);
    }
  }

  void compute(std::size_t i) {
    const Study& study = plan_.study;
    const Campaign& campaign = study.campaigns[i];
    const std::uint64_t key = plan_.keys[i];
    WatchedFiles files = study.jobs[campaign.job].shared;
    files.check_bytes();
    check_key(i, files);
    WorkDirectory work(directory_, key);
    job::Job job = job_of(study, campaign);
    job.directory = work.path().string();
    if (campaign.twin) write_twin(study, *campaign.twin, work.path() / twin_folder, job);
    CampaignResult result = run_or_blame(std::move(job), study.stage, files);
    files.check_untouched();
    check_key(i, files); // a folder may have other files
    fs::remove_all(work.path() / twin_folder);
    write_result(result, key, work.path());
    publish(work, key, !result.missed.empty());
  }

  // A fault of files that changed meanwhile is none of the campaign, which is to be tried again.
  static CampaignResult run_or_blame(job::Job job, LastStage last, const WatchedFiles& files) {
    try {
      return run_campaign(std::move(job), last);
    } catch (const InputError&) {
      files.check_untouched();
      throw;
    }
  }

  // Throws if the campaign's files are not those of its key; watches them from here on.
  void check_key(std::size_t i, WatchedFiles& files) const {
    const Study& study = plan_.study;
    const Campaign& campaign = study.campaigns[i];
    try {
      if (key_of(study, campaign, files) == plan_.keys[i]) return;
    } catch (const InputError&) { // a file is gone
    }
    std::vector<std::string> names = campaign.training;
    names.insert(names.end(), campaign.validation.begin(), campaign.validation.end());
    throw std::runtime_error(
        fmt::format("{}: changed after the study had begun; run it again", join(names, ", ")));
  }

  static void write_result(CampaignResult& result, std::uint64_t key, const fs::path& folder) {
    const fs::path stages = folder / "stages.json";
    result.stages_hash = hash_text(io::hash_of_file(stages, stages.string()));
    io::OutputFiles files(folder);
    files.write(result_file, result_json(result, key_text(key)));
    files.commit();
  }

  void publish(WorkDirectory& work, std::uint64_t key, bool missed) {
    if (!work.publish()) {
      ++counts_.elsewhere;
      return;
    }
    ++counts_.computed;
    counts_.missed += missed;
    std::error_code ignored;
    fs::remove(failure_path(directory_, key), ignored);
    clear_killed(key);
  }

  // Removes working directories that killed processes left for this campaign. A process that still
  // computes it loses its files, but its result exists already.
  void clear_killed(std::uint64_t key) const {
    if (found_.begun.count(key) == 0) return;
    std::error_code ignored;
    const std::string prefix = "." + key_text(key) + ".";
    for (const fs::path& path : os::entries_of(fs::path(directory_) / results_folder))
      if (path.filename().string().starts_with(prefix)) fs::remove_all(path, ignored);
  }

  void fail(std::size_t i, const std::string& message, bool by_input) {
    const std::uint64_t key = plan_.keys[i];
    if (fs::exists(result_directory(directory_, key))) { // another process has cleared our files
      ++counts_.elsewhere;
      return;
    }
    ++counts_.failed;
    counts_.broken += !by_input;
    write_failure(directory_, key, {plan_.study.campaigns[i].name, message, by_input});
  }

  const Plan& plan_;
  const RunOptions& options_;
  const std::string& directory_;
  Found found_;
  RunCounts counts_;
};

} // namespace

RunCounts run_study(const Plan& plan, const RunOptions& options) {
  return StudyRun(plan, options).run();
}

} // namespace frictab::study
