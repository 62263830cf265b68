// The output directory of a job for one command: its lock, what earlier runs left there, the files
// of this run until they are moved into place, the record of stages, and the checkpoint of a run
// that did not end.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/atomic_file.h"
#include "job/job.h"
#include "run/checkpoint.h"
#include "run/result_directory.h"
#include "run/stage.h"
#include "run/stage_record.h"

namespace frictab::run {

class Workspace {
public:
  // Throws InputError where another process writes there, or where files that are called like
  // results are not frictab's (run/results.h).
  explicit Workspace(const job::Job& job);

  // False where the file system has no locks.
  bool is_exclusive() const { return output_.is_exclusive(); }

  // ---- what earlier runs left ----
  const ResultDirectory& earlier() const { return earlier_; }
  const StageRecord& record() const { return record_; }
  // Throws InputError where the stage's results there were made from another job or other data.
  void check_fresh(const Stage& stage, const std::string& data) const;
  // Throws InputError where a result was changed since the stage wrote it.
  void check_as_written(std::string_view stage, const std::string& path) const;

  // ---- the files of this run ----
  void write(const std::string& path, std::string_view text) { output_.write(path, text); }
  std::filesystem::path stage_file(const std::string& path) { return output_.stage(path); }
  std::filesystem::path staged(const std::string& path) const { return output_.staged(path); }
  std::vector<std::string> files() const { return output_.paths(); }
  // Files of an earlier run that commit() removes unless they are written anew: those that are
  // called like results, and those in this folder that stages.json lists.
  void remove_earlier(const std::vector<std::string>& called_like_results, std::string_view folder);
  void remove_earlier(const std::string& path) { output_.remove_old(path); }

  void begin(const std::string& stage, const std::string& data) { record_.begin(stage, data); }
  void record(const std::string& stage, const std::string& data) { record_.record(stage, data); }
  // Moves all files into place.
  void commit();

  // ---- a run of all stages that does not end ----
  // Goes on from what an earlier run had finished, and keeps what this one finishes.
  void resume() { checkpoint_.emplace(job_); }
  const Checkpoint* checkpoint() const { return checkpoint_ ? &*checkpoint_ : nullptr; }
  void take_from_checkpoint(const std::string& path) { output_.take_kept(path); }
  // What is finished so far outlives the process.
  void save_checkpoint();
  // What is kept, for a user who sees this run fail or stops it; empty where nothing is.
  std::string checkpoint_text() const;

private:
  const job::Job& job_;
  io::OutputFiles output_; // first: it finishes what a process that died had begun
  ResultDirectory earlier_;
  StageRecord record_;
  std::optional<Checkpoint> checkpoint_;
  std::atomic<bool> has_saved_ = false; // read when the run is interrupted
};

} // namespace frictab::run
