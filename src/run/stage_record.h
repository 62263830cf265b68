// stages.json: the inputs from which each stage made its results. Later stages read it to check
// whether the results belong to this job and these data.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "job/job.h"

namespace frictab::run {

// Inputs of one stage's results, as hashes (16 hex digits).
struct StageInputs {
  std::string data;    // values and names of the data; first stage only
  std::string job;     // the stage's sections of the job, without table.model
  std::string laws;    // table.model; stage tabulate only
  std::string from;    // all inputs of the stage before; empty for the first
  std::string version; // version of frictab
};

class StageRecord {
public:
  // Reads stages.json of the directory; empty if there is none. Throws InputError if it is damaged.
  StageRecord(const job::Job& job, const std::filesystem::path& directory);

  // Marks a stage as begun: the files it has completed so far are valid.
  void begin(const std::string& stage, const std::string& data);
  // Marks a stage as finished, with data of this fingerprint. Calibration removes the record of
  // tracing.
  void record(const std::string& stage, const std::string& data);

  bool has(const std::string& stage) const { return made_.count(stage) > 0 && open_ != stage; }
  bool has_begun(const std::string& stage) const { return made_.count(stage) > 0; }

  // Records the fingerprint of a file that later stages read. `path`: its path in the directory;
  // `file`: its location now.
  void record_file(const std::string& path, const std::filesystem::path& file);
  std::vector<std::string> recorded_in(std::string_view folder) const; // "models/"
  void forget_file(const std::string& path) { files_.erase(path); }
  // Whether the stages.json read at the start lists any file, or this one.
  bool had_files() const { return !had_files_.empty(); }
  bool had_file(const std::string& path) const { return had_files_.count(path) > 0; }
  // Whether the file still has its recorded fingerprint; nullopt without a record or a file.
  std::optional<bool> is_as_written(const std::string& path) const;

  // First file of a stage that differs from its record; empty: none.
  std::string changed_file(const std::string& stage) const;

  // States how the recorded inputs of a stage differ from the present ones: "[table] of the job has
  // changed since". Empty if they are equal or unknown. A table.model that names laws is not
  // compared, as it selects among the existing tables. `data` is not compared if empty (not read).
  std::string stale(const std::string& stage, const std::string& data) const;

  // Same, but compares only the stage's sections of the job.
  std::string other_job(const std::string& stage) const;

  std::string json() const;

private:
  StageInputs now(const std::string& stage, const std::string& data) const;
  std::string key(const std::string& stage) const; // hash of its recorded inputs
  std::string before(const std::string& stage) const;

  const job::Job& job_;
  std::filesystem::path directory_;
  std::map<std::string, StageInputs> made_;
  std::string open_;                         // stage that has begun and not ended
  std::map<std::string, std::string> files_; // fingerprints by path
  std::set<std::string> had_files_;
};

// Compares the files of a result directory with its stages.json: "models/shear.json is missing",
// "trace.json was changed". Throws InputError if there is no stages.json, or if it is damaged.
std::vector<std::string> differences_in(const std::filesystem::path& directory);

} // namespace frictab::run
