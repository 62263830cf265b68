// stages.json of the kept files says what they are of.
#include "run/kept_work.h"

#include "core/error.h"
#include "io/atomic_file.h"

namespace frictab::run {

namespace {

std::filesystem::path kept_directory(const job::Job& job) {
  return std::filesystem::path(job.directory) / io::kept_name;
}

std::optional<Stages> kept_stages(const job::Job& job) {
  try {
    return std::optional<Stages>(std::in_place, job, kept_directory(job));
  } catch (const InputError&) { // cut short when the power went: made again
    return std::nullopt;
  }
}

} // namespace

KeptWork::KeptWork(const job::Job& job)
    : stages_(kept_stages(job)), files_(job, kept_directory(job)) {}

bool KeptWork::is_current(const std::string& stage, const std::string& data) const {
  if (!stages_ || !stages_->has_begun(stage)) return false;
  for (const std::string& name : stage_names()) {
    if (stages_->has_begun(name) && !stages_->stale(name, data).empty()) return false;
    if (name == stage) break;
  }
  return true;
}

bool KeptWork::has(const std::string& stage, const std::string& data) const {
  return is_current(stage, data) && stages_->has(stage);
}

bool KeptWork::has_calibration(const std::string& data) const {
  if (!has("calibrate", data)) return false;
  if (stages_->has_begun("trace") && !has("trace", data)) return false;
  for (const std::string& path : calibration_files())
    if (!stages_->is_as_written(path).value_or(false)) return false;
  return true;
}

bool KeptWork::has_file(const std::string& stage, const std::string& path,
                        const std::string& data) const {
  return is_current(stage, data) && stages_->is_as_written(path).value_or(false);
}

std::vector<std::string> KeptWork::calibration_files() const {
  std::vector<std::string> files;
  for (const std::string& path : files_.all_files())
    if (path.starts_with("models/") || path == "calibration.json" || path == "benchmark.md" ||
        path == "errors_by_experiment.csv" || path == "trace.json")
      files.push_back(path);
  return files;
}

} // namespace frictab::run
