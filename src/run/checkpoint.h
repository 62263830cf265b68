// Results of a run that did not end, in .frictab-kept of the output directory. The next run resumes
// from them and produces the same bytes.
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
  // Reads the checkpoint in the job's directory; empty if none was saved or it is damaged.
  explicit Checkpoint(const job::Job& job);

  // True if the stage was finished, with these data (a fingerprint) and this job.
  bool has(const std::string& stage, const std::string& data) const;
  // True if calibration was finished, as was tracing if it had begun, and all files of both are
  // unchanged.
  bool has_calibration(const std::string& data) const;
  // True if the stage, finished or not, had completed this file with these data and this job.
  bool has_file(const std::string& stage, const std::string& path, const std::string& data) const;

  const ResultDirectory& files() const { return files_; }
  // Files that calibration and tracing wrote.
  std::vector<std::string> calibration_files() const;

private:
  bool is_current(const std::string& stage, const std::string& data) const;

  std::optional<StageRecord> stages_;
  ResultDirectory files_;
};

} // namespace frictab::run
