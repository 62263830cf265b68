// Other programs (compilers, xlsx2csv) and the directories they work in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace frictab {

// True where a program of this name is on PATH (or is a path that can be executed), or none is
// asked for.
bool have_program(const std::string& name);

// Runs a program without a shell; its output goes to `log`. Throws std::runtime_error with that
// output where it fails.
void run_program(const std::vector<std::string>& command, const std::filesystem::path& log);

// A directory of our own below the system's temporary directory, removed with everything in it.
class TemporaryDirectory {
public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace frictab
