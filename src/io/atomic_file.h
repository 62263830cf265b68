// Output that appears complete or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/interrupt.h"
#include "io/directory_lock.h"

namespace frictab::io {

// Where unfinished work is kept, in a result directory.
inline constexpr const char* kept_name = ".frictab-kept";

// Files of one command. They are written beside what is there, in a staging directory, and moved
// into place by commit(); without commit() nothing changes. Paths are relative to the directory,
// lead nowhere else, and through no symbolic link.
//
// commit() is all or nothing. It syncs the files, compares texts with what was to be written, and
// leaves a journal of its renames in the staging directory; where one of them fails, those before
// are taken back; where the process dies, the next one to write here finishes them.
class OutputFiles {
public:
  // A directory has one such writer at a time. one_file: a single file among others' files, which
  // keeps nobody off.
  enum class Claim { directory, one_file };
  explicit OutputFiles(std::filesystem::path directory, Claim claim = Claim::directory);
  ~OutputFiles(); // removes what was not committed
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  void write(const std::string& path, std::string_view content);
  // A place to write one file by other means (HDF5); committed like the others.
  std::filesystem::path stage(const std::string& path);
  // Where a file of paths() lies until commit().
  std::filesystem::path staged(const std::string& path) const;
  // False where the file system has no locks: a second writer would not be kept off.
  bool is_exclusive() const { return lock_ && lock_->held(); }
  // From here on the staged files are worth keeping without commit(), whatever ends the process:
  // they go to the directory's .frictab-kept, with `record` as its file `name`. commit() removes
  // what is kept there.
  void keep(const std::string& name, std::string_view record);
  // Stages a file that was kept.
  void take_kept(const std::string& path);
  // A file of an earlier run that commit() removes unless it was written anew; directories that
  // become empty go with it.
  void remove_old(const std::string& path);
  // Throws std::runtime_error where the disk refuses.
  void commit();
  // True where a staged file already exists in the directory with other content: what a command
  // that must not overwrite asks before commit().
  bool would_change() const;
  std::vector<std::string> paths() const;                      // staged so far, sorted
  const std::vector<std::string>& old() const { return old_; } // that commit() removes

private:
  void abandon() noexcept;

  std::filesystem::path directory_;
  bool created_ = false; // the directory is ours to remove again
  std::optional<DirectoryLock> lock_;
  std::filesystem::path staging_;
  // The first before the lock is made, which goes before the directory can.
  std::optional<WhenInterrupted> directory_when_interrupted_, when_interrupted_;
  std::vector<std::string> paths_;
  std::map<std::string, std::uint64_t> hashes_; // of texts, by path
  std::vector<std::string> old_;
};

// Finishes what a process that died had begun to commit, if there is such; what reads the
// directory calls it. Does nothing while somebody writes there; throws InputError where it cannot
// be finished.
void finish_interrupted(const std::filesystem::path& directory);

// The whole file; throws InputError where it cannot be read.
std::string read_file(const std::filesystem::path& file);

} // namespace frictab::io
