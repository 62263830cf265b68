// Runs a program as a user would: argv in; stdout, stderr and exit code out.
#pragma once

#include <string>
#include <vector>

namespace frictab::test {

struct CommandResult {
  int exit_code = -1; // 128 + signal where a signal ended it
  std::string out;
  std::string err;
};

// Standard input is empty. `directory` is where it runs (empty: here); `environment` holds
// "NAME=value" that replace the caller's. Throws std::runtime_error where it cannot be started.
CommandResult run_command(const std::vector<std::string>& argv, const std::string& directory = "",
                          const std::vector<std::string>& environment = {});

// Of the build that this test program is of: the frictab program, and the library by which calls
// fail (failing_disk.c).
std::string program();
std::string failing_disk();

// run_command of the frictab program.
CommandResult run_frictab(std::vector<std::string> arguments, const std::string& directory = "",
                          const std::vector<std::string>& environment = {});

// A new empty directory, removed with everything in it at the end.
class TemporaryDirectory {
public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::string path(const std::string& below = "") const;
  // Writes a file below it, with its directories; gives its path.
  std::string write(const std::string& file, const std::string& content) const;
  std::string read(const std::string& file) const;

private:
  std::string path_;
};

} // namespace frictab::test
