// Access rights, flushing, unique directories and globs of POSIX.
#include "core/os/files.h"

#include <cerrno>
#include <cstdlib>

#include <fcntl.h>
#include <fnmatch.h>
#include <glob.h>
#include <unistd.h>

namespace frictab::os {

namespace fs = std::filesystem;

bool may_read(const fs::path& path) {
  return ::access(path.c_str(), R_OK) == 0;
}

bool may_write(const fs::path& path) {
  return ::access(path.c_str(), W_OK) == 0;
}

bool may_run(const fs::path& path) {
  return ::access(path.c_str(), X_OK) == 0;
}

void flush_to_disk(const fs::path& path) {
  const auto cannot = [&](const char* what, int why) {
    throw std::system_error(why, std::generic_category(), what + path.string());
  };
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) cannot("cannot open ", errno);
  // Some file systems cannot sync directories and fail with EINVAL or ENOTSUP.
  const bool done = ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP;
  const int error = errno;
  const bool closed = ::close(file) == 0;
  if (!done || !closed) cannot("cannot write ", done ? errno : error);
}

fs::path make_unique_directory(const fs::path& beginning, std::error_code& error) {
  std::string name = beginning.string() + "XXXXXX";
  if (!::mkdtemp(name.data())) error.assign(errno, std::generic_category());
  return name;
}

std::vector<std::string> paths_like(const std::string& glob) {
  glob_t found{};
  std::vector<std::string> paths;
  if (::glob(glob.c_str(), GLOB_NOSORT, nullptr, &found) == 0)
    paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  return paths;
}

bool is_like(const std::string& name, const std::string& glob) {
  return ::fnmatch(glob.c_str(), name.c_str(), FNM_PATHNAME) == 0;
}

} // namespace frictab::os
