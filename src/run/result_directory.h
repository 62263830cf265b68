// Files of earlier runs in a job's output directory: the results that later stages load, and the
// files that a stage replaces.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/calibration.h"
#include "codegen/exporter.h"
#include "job/job.h"
#include "table/table.h"
#include "trace/trace.h"
#include "verify/verification.h"

namespace frictab::run {

class ResultDirectory {
public:
  explicit ResultDirectory(const job::Job& job);
  ResultDirectory(const job::Job& job, std::filesystem::path directory);

  // Results. If one is missing, functions for required results throw InputError with the command
  // that makes it; the others return an empty value.
  bool has_calibration() const;
  bool has_tables() const;
  calibrate::Calibration calibration() const;
  std::vector<table::Table> tables() const;
  // All files below the directory, as sorted relative paths.
  std::vector<std::string> all_files() const;
  codegen::SourceBundle sources(const std::string& directory) const; // export/c, export/c/coulomb
  // Returns "export/c" or "export/c/coulomb", whichever holds this model's sources; the second if
  // neither does.
  std::string source_directory(const std::string& target, const std::string& model) const;
  std::vector<trace::Trace> traces() const;
  std::optional<verify::Verification> verification() const;

  // Files written by frictab, as relative paths, which a stage replaces as a whole. Excludes files
  // that a user has added there.
  std::vector<std::string> model_files() const;  // models/NAME.json
  std::vector<std::string> table_files() const;  // tables/NAME.h5 and its work files
  std::vector<std::string> source_files() const; // files listed in recipes

private:
  std::vector<std::filesystem::path> table_paths() const;
  std::vector<std::filesystem::path> all_tables() const; // at least one
  std::vector<std::string> table_names() const;

  std::filesystem::path directory_;
  std::string job_; // for hints
  models::Laws laws_;
};

} // namespace frictab::run
