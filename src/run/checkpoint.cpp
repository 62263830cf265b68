// The stages.json among the kept files records the job and the data they were made from.
#include "run/checkpoint.h"

#include <algorithm>

#include "core/error.h"
#include "io/atomic_file.h"
#include "run/stage.h"

namespace frictab::run {

namespace {

std::filesystem::path kept_directory(const job::Job& job) {
  return std::filesystem::path(job.directory) / io::kept_name;
}

std::optional<StageRecord> kept_stages(const job::Job& job) {
  try {
    return std::optional<StageRecord>(std::in_place, job, kept_directory(job));
  } catch (const InputError&) { // damaged, for example by a power failure: recomputed
    return std::nullopt;
  }
}

} // namespace

Checkpoint::Checkpoint(const job::Job& job)
    : stages_(kept_stages(job)), files_(job, kept_directory(job)) {}

bool Checkpoint::is_current(const std::string& stage, const std::string& data) const {
  if (!stages_ || !stages_->has_begun(stage)) return false;
  for (const Stage& one : all_stages()) {
    if (stages_->has_begun(one.name) && !stages_->stale(one.name, data).empty()) return false;
    if (one.name == stage) break;
  }
  return true;
}

bool Checkpoint::has(const std::string& stage, const std::string& data) const {
  return is_current(stage, data) && stages_->has(stage);
}

bool Checkpoint::has_calibration(const std::string& data) const {
  if (!has("calibrate", data)) return false;
  if (stages_->has_begun("trace") && !has("trace", data)) return false;
  for (const std::string& path : calibration_files())
    if (!stages_->is_as_written(path).value_or(false)) return false;
  return true;
}

bool Checkpoint::has_file(const std::string& stage, const std::string& path,
                          const std::string& data) const {
  return is_current(stage, data) && stages_->is_as_written(path).value_or(false);
}

std::vector<std::string> Checkpoint::calibration_files() const {
  std::vector<std::string> files;
  const std::vector<std::string> of_trace = stage_named("trace").writes();
  std::vector<std::string> written = stage_named("calibrate").writes();
  written.insert(written.end(), of_trace.begin(), of_trace.end());
  for (const std::string& path : files_.all_files())
    if (std::ranges::any_of(written,
                            [&](const std::string& start) { return path.starts_with(start); }))
      files.push_back(path);
  return files;
}

} // namespace frictab::run
