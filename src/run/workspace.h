// The output directory of a job during one command: its lock, the results of earlier runs, the
// files of this run until they are moved into place, the record of stages, and the checkpoint of a
// run that did not end.
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
  // Locks the directory. Throws InputError if another process writes there, or if files named like
  // results were not written by frictab (run/results.h).
  explicit Workspace(const job::Job& job);

  // False if the file system has no locks.
  bool is_exclusive() const { return output_.is_exclusive(); }

  // ---- results of earlier runs ----
  const ResultDirectory& earlier() const { return earlier_; }
  const StageRecord& record() const { return record_; }
  // Throws InputError if the stage's earlier results were made from another job or other data.
  void check_fresh(const Stage& stage, const std::string& data) const;
  // Throws InputError if a result was changed since the stage wrote it.
  void check_as_written(std::string_view stage, const std::string& path) const;

  // ---- files of this run ----
  void write(const std::string& path, std::string_view text) { output_.write(path, text); }
  std::filesystem::path stage_file(const std::string& path) { return output_.stage(path); }
  std::filesystem::path staged(const std::string& path) const { return output_.staged(path); }
  std::vector<std::string> files() const { return output_.paths(); }
  // Marks files of an earlier run that commit() removes unless this run writes them again: files
  // named like results, and all files in this folder that stages.json lists.
  void remove_earlier(const std::vector<std::string>& called_like_results, std::string_view folder);
  void remove_earlier(const std::string& path) { output_.remove_old(path); }

  void begin(const std::string& stage, const std::string& data) { record_.begin(stage, data); }
  void record(const std::string& stage, const std::string& data) { record_.record(stage, data); }
  // Moves all files into place, or none.
  void commit();

  // ---- checkpoint of a run of all stages ----
  // Opens the checkpoint of an earlier run; from here on save_checkpoint() saves.
  void resume() { checkpoint_.emplace(job_); }
  const Checkpoint* checkpoint() const { return checkpoint_ ? &*checkpoint_ : nullptr; }
  void take_from_checkpoint(const std::string& path) { output_.take_kept(path); }
  // Saves the files of this run so far, so that they outlive the process.
  void save_checkpoint();
  // Message about the saved checkpoint for a user whose run fails or is interrupted; empty if
  // nothing was saved.
  std::string checkpoint_text() const;

private:
  const job::Job& job_;
  // First member: its constructor finishes an interrupted commit before the others read.
  io::OutputFiles output_;
  ResultDirectory earlier_;
  StageRecord record_;
  std::optional<Checkpoint> checkpoint_;
  std::atomic<bool> has_saved_ = false; // read by the thread that handles interruptions
};

} // namespace frictab::run
