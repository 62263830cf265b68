// Output that appears complete or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/os/interrupt.h"
#include "io/directory_lock.h"

namespace frictab::io {

// Folder of a result directory that stores unfinished work.
inline constexpr const char* kept_name = ".frictab-kept";

// Output files of one command. They are written into a staging directory next to the existing files
// and moved into place by commit(); without commit() nothing changes. Paths are relative to the
// directory and may neither leave it nor pass through a symbolic link.
//
// commit() is all or nothing. It syncs the files and leaves a journal of its renames in the staging
// directory. If a rename fails, the earlier ones are undone; if the process dies, the next writer
// in this directory finishes them.
class OutputFiles {
public:
  // directory: the only writer in its directory. one_file: writes one file among others' files and
  // takes no lock.
  enum class Claim { directory, one_file };
  explicit OutputFiles(std::filesystem::path directory, Claim claim = Claim::directory);
  ~OutputFiles(); // removes uncommitted files
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  void write(const std::string& path, std::string_view content);
  // Path for a file that is written by other means (an OutputFile, a table) and committed like the
  // others.
  std::filesystem::path stage(const std::string& path);
  // Location of a file of paths() until commit().
  std::filesystem::path staged(const std::string& path) const;
  // False if the file system has no locks: a second writer would then not be excluded.
  bool is_exclusive() const { return lock_ && lock_->is_locked(); }
  // Makes the staged files survive the end of the process without commit(): from here on they then
  // move to the directory's .frictab-kept, with `record` as its file `name`. commit() removes the
  // contents of .frictab-kept.
  void keep(const std::string& name, std::string_view record);
  // Stages a file from .frictab-kept.
  void take_kept(const std::string& path);
  // Marks a file of an earlier run that commit() removes unless it was written again; directories
  // that become empty are removed as well.
  void remove_old(const std::string& path);
  // Throws std::runtime_error if writing to the disk fails.
  void commit();
  // True if a staged file already exists in the directory with different content; for commands that
  // must not overwrite, before commit().
  bool would_change() const;
  std::vector<std::string> paths() const;                      // staged so far, sorted
  const std::vector<std::string>& old() const { return old_; } // files that commit() removes

private:
  void abandon() noexcept;

  std::filesystem::path directory_;
  bool created_ = false; // this object created the directory and may remove it
  std::optional<DirectoryLock> lock_;
  std::filesystem::path staging_;
  // Constructed before the lock, because the lock has to go before the directory can.
  std::optional<os::WhenInterrupted> directory_when_interrupted_, when_interrupted_;
  std::vector<std::string> paths_;
  std::vector<std::string> old_;
};

// Finishes the commit of a process that died, if there is one; readers of the directory call it.
// Does nothing while another process writes there. Throws InputError if the commit cannot be
// finished.
void finish_interrupted(const std::filesystem::path& directory);

} // namespace frictab::io
