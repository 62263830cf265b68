// Reads and writes by POSIX calls.
#include "core/os/open_file.h"

#include <algorithm>
#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace frictab::os {

namespace {

[[noreturn]] void fail() {
  throw std::system_error(errno, std::generic_category());
}

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

} // namespace

FileToRead::FileToRead(const std::filesystem::path& path)
    : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  struct stat status {};
  if (file_ < 0) fail();
  if (::fstat(file_, &status) != 0) {
    const int why = errno;
    ::close(file_);
    throw std::system_error(why, std::generic_category());
  }
  kind_ = S_ISREG(status.st_mode)   ? Kind::file
          : S_ISDIR(status.st_mode) ? Kind::directory
                                    : Kind::pipe_or_device;
  state_ = {status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size),
            nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

FileToRead::~FileToRead() {
  ::close(file_);
}

std::size_t FileToRead::read(std::uint64_t at, std::span<char> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::pread(file_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(at + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail();
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

FileToWrite::FileToWrite(const std::filesystem::path& path)
    : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail();
}

FileToWrite::~FileToWrite() {
  if (file_ >= 0) ::close(file_);
}

void FileToWrite::write(std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(file_, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put == 0) errno = ENOSPC;
    if (put <= 0) fail();
    bytes = bytes.subspan(static_cast<std::size_t>(put));
  }
}

void FileToWrite::close() {
  const int file = file_;
  file_ = -1;
  if (::close(file) != 0) fail();
}

} // namespace frictab::os
