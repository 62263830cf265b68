// Access rights, flushing, unique directories and globs of POSIX.
#include "core/os/files.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include <fcntl.h>
#include <fnmatch.h>
#include <glob.h>
#include <unistd.h>

namespace frictab::os {

namespace fs = std::filesystem;

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

std::vector<fs::path> entries_of(const fs::path& directory) {
  std::vector<fs::path> paths;
  std::error_code error;
  for (fs::directory_iterator at(directory, error), end; !error && at != end; at.increment(error))
    paths.push_back(at->path());
  if (error && error != std::errc::no_such_file_or_directory)
    throw std::system_error(error, "cannot list " + directory.string());
  std::ranges::sort(paths);
  return paths;
}

std::vector<std::string> paths_like(const std::string& glob) {
  glob_t found{};
  std::vector<std::string> paths;
  const auto is_fault = [](const char*, int error) {
    return error == ENOENT || error == ENOTDIR ? 0 : 1; // nothing there
  };
  const int answer = ::glob(glob.c_str(), GLOB_NOSORT, is_fault, &found);
  const int why = errno;
  if (answer == 0) paths.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (answer != 0 && answer != GLOB_NOMATCH)
    throw std::system_error(why, std::generic_category(), "cannot list all of " + glob);
  return paths;
}

bool is_like(const std::string& name, const std::string& glob) {
  return ::fnmatch(glob.c_str(), name.c_str(), FNM_PATHNAME) == 0;
}

} // namespace frictab::os
