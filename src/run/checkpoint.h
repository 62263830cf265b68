// What a run that did not end had finished: the next one goes on from there, to the same bytes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/result_directory.h"
#include "run/stage_record.h"

namespace frictab::run {

class Checkpoint {
public:
  // Of the job's directory; empty where nothing is kept there, or where it is damaged.
  explicit Checkpoint(const job::Job& job);

  // The stage was finished, with these data and this job.
  bool has(const std::string& stage, const std::string& data) const;
  // Of such a calibration, and of a trace behind it if there is one, all files are there.
  bool has_calibration(const std::string& data) const;
  // A stage that had begun, with these data and this job, has finished this file.
  bool has_file(const std::string& stage, const std::string& path, const std::string& data) const;

  const ResultDirectory& files() const { return files_; }
  // What calibration and tracing wrote.
  std::vector<std::string> calibration_files() const;

private:
  bool is_current(const std::string& stage, const std::string& data) const;

  std::optional<StageRecord> stages_;
  ResultDirectory files_;
};

} // namespace frictab::run
