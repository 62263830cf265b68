// Programs that run as processes of their own.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace frictab::os {

// Returns the first executable file of that name on PATH, as run_process finds it; "" without one.
std::string on_path(const std::string& program);

enum class Ended { well, badly, too_late };

// Runs a program without a shell; it reads nothing, its output goes to `log`. When it ends or
// exceeds `patience`, or if this process is interrupted, every process of it that still runs is
// killed. Throws std::runtime_error if it cannot be started.
Ended run_process(const std::vector<std::string>& command, const std::filesystem::path& log,
                  std::chrono::seconds patience);

} // namespace frictab::os
