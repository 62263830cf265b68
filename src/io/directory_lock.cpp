// flock on a file that exists only while it is locked.
#include "io/directory_lock.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <ctime>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"

namespace frictab::io {

namespace {

constexpr std::chrono::seconds patience{5};
constexpr std::chrono::milliseconds pause{50};

std::string me() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return fmt::format("process {} on {} since {:%Y-%m-%d %H:%M:%S}", ::getpid(), host,
                     fmt::localtime(std::time(nullptr)));
}

// First line of the text that the lock's owner wrote.
std::string holder(int file) {
  char text[300] = {};
  const ssize_t got = ::pread(file, text, sizeof text - 1, 0);
  std::string line(text, got > 0 ? static_cast<std::size_t>(got) : 0);
  line = line.substr(0, line.find('\n'));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return line.empty() ? "another process" : line;
}

// True if the open file still has this name; its previous owner may have removed it.
bool is_there(int file, const std::filesystem::path& name) {
  struct stat open {
  }, named{};
  return ::fstat(file, &open) == 0 && ::lstat(name.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

} // namespace

void cannot_write_here(const std::filesystem::path& directory, const std::string& why) {
  throw InputError({directory.string(), 0, 0}, "cannot write here: " + why,
                   "choose another directory with -o DIR");
}

// False if no lock is available.
bool DirectoryLock::open_and_lock(const std::filesystem::path& directory, Wish wish) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (true) {
    open_ = ::open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (open_ < 0 && wish == Wish::if_free) return false;
    if (open_ < 0) cannot_write_here(directory, std::strerror(errno));
    const bool locked = ::flock(open_, LOCK_EX | LOCK_NB) == 0;
    if (locked && is_there(open_, file_)) return true;
    // file system without locks
    if (!locked && errno != EWOULDBLOCK && errno != EINTR) return false;
    const std::string who = locked ? "" : holder(open_);
    ::close(std::exchange(open_, -1));
    if (!locked && wish == Wish::if_free) return false;
    if (std::chrono::steady_clock::now() > end)
      throw InputError({directory.string(), 0, 0}, "another frictab is writing here: " + who,
                       "wait until it has finished, or choose another directory with -o DIR");
    std::this_thread::sleep_for(pause);
  }
}

DirectoryLock::DirectoryLock(const std::filesystem::path& directory, Wish wish)
    : file_(directory / ".frictab.lock"), locked_(open_and_lock(directory, wish)) {
  if (!locked_) return;
  when_interrupted_.emplace([file = file_] { ::unlink(file.c_str()); });
  const std::string text = me() + "\n";
  if (::ftruncate(open_, 0) != 0 || ::pwrite(open_, text.data(), text.size(), 0) < 0) {
    // the lock is valid even without the text
  }
}

DirectoryLock::~DirectoryLock() {
  if (open_ < 0) return;
  // a waiting process notices that the name now refers to another file
  if (locked_) ::unlink(file_.c_str());
  ::close(open_);
}

} // namespace frictab::io
