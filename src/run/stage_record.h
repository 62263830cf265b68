// stages.json: what the results in an output directory were made from, stage by stage. A stage that
// goes on from them knows by it whether they are of this job and these data.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "job/job.h"

namespace frictab::run {

// What one stage's results depend on, as hashes (16 hex digits).
struct StageInputs {
  std::string data;    // of the first: values and names of the data
  std::string job;     // the stage's sections of the job, table.model left out
  std::string laws;    // table.model, of the stage that makes the tables
  std::string from;    // the stage before; empty for the first
  std::string version; // of frictab
};

class StageRecord {
public:
  // As stages.json of the directory says; nothing where there is none. Throws InputError where it
  // is damaged.
  StageRecord(const job::Job& job, const std::filesystem::path& directory);

  // A stage has begun; what it has made so far is known as such.
  void begin(const std::string& stage, const std::string& data);
  // A stage has run on data of this fingerprint. Calibration drops what tracing had added.
  void record(const std::string& stage, const std::string& data);

  bool has(const std::string& stage) const { return made_.count(stage) > 0 && open_ != stage; }
  bool has_begun(const std::string& stage) const { return made_.count(stage) > 0; }

  // A file that later stages read, by its path in the directory, as it was written to `file`.
  void record_file(const std::string& path, const std::filesystem::path& file);
  std::vector<std::string> recorded_in(std::string_view folder) const; // "models/"
  void forget_file(const std::string& path) { files_.erase(path); }
  // Whether the stages.json that was read has any file, or this one; one recorded since does not
  // count.
  bool had_files() const { return !had_files_.empty(); }
  bool had_file(const std::string& path) const { return had_files_.count(path) > 0; }
  // Whether the file is the one that was recorded; nothing where none was.
  std::optional<bool> is_as_written(const std::string& path) const;

  // The first file of a stage that is no longer as it was recorded; empty: none.
  std::string changed_file(const std::string& stage) const;

  // In words, how what a stage was made from differs from what it would be made from now: "[table]
  // of the job has changed since"; empty where it does not, or nothing is known of it. A
  // table.model that names laws picks among the tables there are. `data` empty: they were not read,
  // and are not compared.
  std::string stale(const std::string& stage, const std::string& data) const;

  // The same, as far as it is the job that says something else of the stage.
  std::string other_job(const std::string& stage) const;

  std::string json() const;

private:
  StageInputs now(const std::string& stage, const std::string& data) const;
  std::string key(const std::string& stage) const; // of its recorded inputs
  std::string before(const std::string& stage) const;

  const job::Job& job_;
  std::filesystem::path directory_;
  std::map<std::string, StageInputs> made_;
  std::string open_;                         // the stage that has begun and not ended
  std::map<std::string, std::string> files_; // fingerprints by path
  std::set<std::string> had_files_;
};

} // namespace frictab::run
