// Programs that run as processes of their own.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace frictab::os {

// Returns the absolute name of the first executable file of that name in the safe folders of PATH,
// as run_process finds it; "" without one. A folder is not safe if its name is empty or relative,
// if it is the working directory, or if everybody may write to it: somebody else may have put the
// file there.
std::string on_path(const std::string& program);

// The environment, "NAME=value", for programs that are started. PATH has its safe folders alone.
// Lists of what compilers and the dynamic linker load, for example LD_LIBRARY_PATH, lose their
// empty and relative entries: these mean the working directory.
std::vector<std::string> environment_for_programs();

struct ProcessLimits {
  std::chrono::seconds time;
  std::uint64_t memory_bytes; // of each of its processes
};

enum class Ended { well, badly, too_late };

struct ProcessResult {
  Ended ended = Ended::badly;
  // Its output on both streams: the beginning and what follows it, of which only the end is kept.
  std::string beginning, end;
  std::uint64_t bytes = 0; // of the whole output
};

// Runs a program without a shell in `directory`, to which it may refer by relative names; it reads
// nothing. When it ends or exceeds its time, or if this process is interrupted, every process of it
// that still runs is killed. A program without '/' in its name is looked for as by on_path. Throws
// std::runtime_error if it cannot be found or started.
ProcessResult run_process(const std::vector<std::string>& command,
                          const std::filesystem::path& directory, const ProcessLimits& limits);

} // namespace frictab::os
