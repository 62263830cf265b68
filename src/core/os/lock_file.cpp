// Locks by flock(2).
#include "core/os/lock_file.h"

#include <cerrno>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace frictab::os {

// True if the open file still has this name; its previous owner may have removed it.
static bool is_there(int file, const std::filesystem::path& name) {
  struct stat open {
  }, named{};
  return ::fstat(file, &open) == 0 && ::lstat(name.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

LockFile::Answer LockFile::try_to_lock(std::error_code& error) {
  do {
    if (open_ >= 0) ::close(open_);
    open_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (open_ < 0) {
      error.assign(errno, std::generic_category());
      return Answer::impossible;
    }
    if (::flock(open_, LOCK_EX | LOCK_NB) != 0)
      return errno == EWOULDBLOCK || errno == EINTR ? Answer::taken : Answer::impossible;
  } while (!is_there(open_, file_));
  locked_ = true;
  return Answer::locked;
}

std::string LockFile::text() const {
  char text[300] = {};
  const ssize_t got = ::pread(open_, text, sizeof text - 1, 0);
  return {text, got > 0 ? static_cast<std::size_t>(got) : 0};
}

void LockFile::write(const std::string& text) const noexcept {
  if (::ftruncate(open_, 0) != 0 || ::pwrite(open_, text.data(), text.size(), 0) < 0) {
    // the lock is valid even without the text
  }
}

LockFile::~LockFile() {
  // a waiting process notices that the name now refers to another file
  if (locked_) ::unlink(file_.c_str());
  if (open_ >= 0) ::close(open_);
}

} // namespace frictab::os
