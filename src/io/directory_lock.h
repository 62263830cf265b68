// One writer at a time in a directory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/interrupt.h"

namespace frictab::io {

// Throws InputError: nothing can be written in this directory, and why.
[[noreturn]] void cannot_write_here(const std::filesystem::path& directory, const std::string& why);

// Holds DIRECTORY/.frictab.lock by flock(2), which ends with the process however it ends; the file
// says who holds it and is gone afterwards. Where the file system has no locks (some network file
// systems) nothing is held.
class DirectoryLock {
public:
  // must: waits a few seconds for who holds it; throws InputError that names it then, or says why
  // nothing can be written there. if_free: held() says whether it was.
  enum class Wish { must, if_free };
  explicit DirectoryLock(const std::filesystem::path& directory, Wish wish = Wish::must);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  bool held() const { return held_; }

private:
  bool open_and_lock(const std::filesystem::path& directory, Wish wish);

  std::filesystem::path file_;
  int open_ = -1;
  bool held_;
  std::optional<WhenInterrupted> when_interrupted_;
};

} // namespace frictab::io
