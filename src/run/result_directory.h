// What earlier runs left in a job's output directory: results that a later stage goes on from, and
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

  // Results. Those that a stage cannot do without throw InputError where they are missing, with the
  // command that makes them; the others are empty.
  bool has_calibration() const;
  bool has_tables() const;
  calibrate::Calibration calibration() const;
  std::vector<table::Table> tables() const;
  // All files below it, as paths in it, sorted.
  std::vector<std::string> all_files() const;
  codegen::SourceBundle sources(const std::string& directory) const; // export/c, export/c/coulomb
  // The one of these two that holds this model's sources; where none does, the second.
  std::string source_directory(const std::string& target, const std::string& model) const;
  std::vector<trace::Trace> traces() const;
  std::optional<verify::Verification> verification() const;

  // Files of the tool itself, relative to the directory, that a stage replaces as a whole. Files
  // that a user put beside them are not among them.
  std::vector<std::string> model_files() const;  // models/NAME.json
  std::vector<std::string> table_files() const;  // tables/NAME.h5 and its work files
  std::vector<std::string> source_files() const; // those that recipes list

private:
  std::vector<std::filesystem::path> table_paths() const;
  std::vector<std::filesystem::path> all_tables() const; // at least one
  std::vector<std::string> table_names() const;

  std::filesystem::path directory_;
  std::string job_; // for hints
  models::Laws laws_;
};

} // namespace frictab::run
