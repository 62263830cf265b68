// A file that exists only while it is locked.
#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace frictab::os {

// The lock ends with the process in every case.
class LockFile {
public:
  explicit LockFile(std::filesystem::path file) : file_(std::move(file)) {}
  ~LockFile(); // unlocks, and removes the file if it was locked here
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

  // Makes the file if it is missing, never through a symbolic link, and locks it without waiting.
  // impossible: the file cannot be opened, which sets `error`, or the file system has no locks
  // (some network file systems).
  enum class Answer { locked, taken, impossible };
  Answer try_to_lock(std::error_code& error);
  std::string text() const;                           // the beginning of what the owner wrote
  void write(const std::string& text) const noexcept; // at best

private:
  std::filesystem::path file_;
  int open_ = -1;
  bool locked_ = false;
};

} // namespace frictab::os
