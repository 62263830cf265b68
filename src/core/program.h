// External programs (compilers) and their working directories.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/os/interrupt.h"
#include "core/os/process.h"

namespace frictab {

// True if a program of this name is on PATH (or is an executable path), or if the name is empty.
bool have_program(const std::string& name);

// Limits of a compiler or interpreter, which may hang, for example waiting for a licence, or grow:
// 120 s and 8 GiB for each of its processes, or what the environment has as FRICTAB_COMPILE_SECONDS
// and FRICTAB_COMPILE_GIB. Throws InputError if that is not a number above 0.
os::ProcessLimits usual_limits();

// Runs a program without a shell in `directory` and returns its output, of a long one the beginning
// and the end. Throws std::runtime_error with that output if the program fails or exceeds its time;
// in the latter case the program and every process it has started are killed.
std::string run_program(const std::vector<std::string>& command,
                        const std::filesystem::path& directory,
                        const os::ProcessLimits& limits = usual_limits());

// TMPDIR as an absolute path, or /tmp if that is unset or empty.
std::filesystem::path temporary_place();

// A new directory below temporary_place(), removed with all its contents.
class TemporaryDirectory {
public:
  TemporaryDirectory(); // throws InputError if none can be created
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::optional<os::WhenInterrupted> when_interrupted_;
};

} // namespace frictab
