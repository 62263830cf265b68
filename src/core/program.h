// Other programs (compilers, xlsx2csv) and the directories they work in.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/interrupt.h"

namespace frictab {

// True where a program of this name is on PATH (or is a path that can be executed), or none is
// asked for.
bool have_program(const std::string& name);

// A program that does not end: a compiler that waits for a licence, say.
inline constexpr std::chrono::seconds usual_patience{600};

// Runs a program without a shell; its output goes to `log`. Throws std::runtime_error with the
// beginning and the end of that output where it fails, or where it does not end in time: it is then
// killed, with all that it has started.
void run_program(const std::vector<std::string>& command, const std::filesystem::path& log,
                 std::chrono::seconds patience = usual_patience);

// TMPDIR; /tmp where that is not set or empty.
std::filesystem::path temporary_place();

// A directory of our own below that place, removed with everything in it.
class TemporaryDirectory {
public:
  TemporaryDirectory(); // throws InputError where none can be made
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
  std::optional<WhenInterrupted> when_interrupted_;
};

} // namespace frictab
