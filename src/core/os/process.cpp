// Runs programs by posix_spawn.
#include "core/os/process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/os/files.h"
#include "core/os/interrupt.h"

extern char** environ;

namespace frictab::os {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds longest_pause{5};

class SpawnSettings {
public:
  explicit SpawnSettings(const fs::path& log) {
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions, 1, 2);
    posix_spawnattr_init(&attributes);
    sigset_t none; // the child has no thread that waits for signals (interrupt.h)
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

// Exit status; nullopt if the child does not end in time.
std::optional<int> wait_for(pid_t child, std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  for (std::chrono::milliseconds pause(1);; pause = std::min(2 * pause, longest_pause)) {
    int status = 0;
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) throw std::runtime_error("lost a program while it ran");
    if (std::chrono::steady_clock::now() > end) return std::nullopt;
    std::this_thread::sleep_for(pause);
  }
}

} // namespace

std::string on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::string rest = path ? path : "/bin:/usr/bin";
  while (true) {
    const std::size_t colon = rest.find(':');
    const fs::path directory = rest.substr(0, colon);
    const fs::path file = directory.empty() ? fs::path(".") / program : directory / program;
    std::error_code error;
    if (fs::is_regular_file(file, error) && may_run(file)) return file.string();
    if (colon == rest.npos) return "";
    rest.erase(0, colon + 1);
  }
}

Ended run_process(const std::vector<std::string>& command, const fs::path& log,
                  std::chrono::seconds patience) {
  std::vector<char*> argv;
  for (const std::string& word : command)
    argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const SpawnSettings settings(log);
  pid_t child = 0;
  const int failed =
      posix_spawnp(&child, argv[0], &settings.actions, &settings.attributes, argv.data(), environ);
  if (failed != 0)
    throw std::runtime_error("cannot run " + command[0] + ": " + std::strerror(failed));
  const WhenInterrupted killed([child] { ::kill(-child, SIGKILL); });
  const std::optional<int> status = wait_for(child, patience);
  ::kill(-child, SIGKILL); // kills the processes it has started as well
  if (!status) {
    ::waitpid(child, nullptr, 0);
    return Ended::too_late;
  }
  return WIFEXITED(*status) && WEXITSTATUS(*status) == 0 ? Ended::well : Ended::badly;
}

} // namespace frictab::os
