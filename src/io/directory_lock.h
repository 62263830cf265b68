// Lock for one writer at a time in a directory.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/os/interrupt.h"
#include "core/os/lock_file.h"

namespace frictab::io {

// Throws InputError: the directory cannot be written to, and why.
[[noreturn]] void cannot_write_here(const std::filesystem::path& directory, const std::string& why);

// Locks DIRECTORY/.frictab.lock; the file names its owner and is removed afterwards. If the file
// system has no locks (some network file systems), nothing is locked.
class DirectoryLock {
public:
  // must: waits a few seconds for the current owner; throws InputError that names an owner who
  // stays, or gives the reason if nothing can be written there. if_free: never waits; is_locked()
  // returns whether the lock was free.
  enum class Wish { must, if_free };
  explicit DirectoryLock(const std::filesystem::path& directory, Wish wish = Wish::must);
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  bool is_locked() const { return locked_; }

private:
  bool lock(const std::filesystem::path& directory, Wish wish);

  std::optional<os::WhenInterrupted> when_interrupted_;
  os::LockFile file_;
  bool locked_;
};

} // namespace frictab::io
