// External programs (compilers) and their working directories.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/os/interrupt.h"

namespace frictab {

// True if a program of this name is on PATH (or is an executable path), or if the name is empty.
bool have_program(const std::string& name);

// Time limit for a program that may hang, for example a compiler that waits for a licence.
inline constexpr std::chrono::seconds usual_patience{600};

// Runs a program without a shell; its output goes to `log`. Throws std::runtime_error with the
// beginning and the end of that output if the program fails or exceeds `patience`; in the latter
// case the program and every process it has started are killed.
void run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                 std::chrono::seconds patience = usual_patience);

// TMPDIR, or /tmp if that is unset or empty.
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
