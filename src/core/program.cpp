// Runs programs by posix_spawn, without a shell.
#include "core/program.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"
#include "core/text.h"

extern char** environ;

namespace frictab {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::milliseconds longest_pause{5};
constexpr std::size_t shown_at_each_end = 4000;

// A compiler may repeat one message a million times.
std::string beginning_and_end(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(2 * shown_at_each_end + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() <= 2 * shown_at_each_end) return text;
  in.clear();
  in.seekg(-static_cast<std::streamoff>(shown_at_each_end), std::ios::end);
  std::string end(shown_at_each_end, '\0');
  in.read(end.data(), static_cast<std::streamsize>(end.size()));
  std::error_code ignored;
  const auto size = static_cast<double>(fs::file_size(file, ignored));
  return text.substr(0, shown_at_each_end) + "\n[... " + human_bytes(size) + " in all ...]\n" + end;
}

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

// Returns the exit status as waitpid gives it.
int run(const std::vector<std::string>& command, const fs::path& log,
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
  if (status) return *status;
  ::waitpid(child, nullptr, 0);
  throw std::runtime_error(fmt::format("{}\ndid not end within {} s and was stopped\n{}",
                                       join(command, " "), patience.count(),
                                       beginning_and_end(log)));
}

} // namespace

bool have_program(const std::string& name) {
  if (name.empty()) return true;
  if (name.find('/') != std::string::npos) return access(name.c_str(), X_OK) == 0;
  const char* path = std::getenv("PATH");
  std::istringstream directories(path ? path : "/usr/bin:/bin");
  for (std::string directory; std::getline(directories, directory, ':');)
    if (access((directory + "/" + name).c_str(), X_OK) == 0) return true;
  return false;
}

void run_program(const std::vector<std::string>& command, const fs::path& log,
                 std::chrono::seconds patience) {
  const int status = run(command, log, patience);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(join(command, " ") + "\n" + beginning_and_end(log));
}

fs::path temporary_place() {
  const char* const said = std::getenv("TMPDIR");
  return said && *said ? said : "/tmp";
}

namespace {

// Removes twice, because other threads may still write to the tree during an interruption.
void remove_tree(const fs::path& path) noexcept {
  std::error_code ignored;
  for (int time = 0; time < 2; ++time)
    fs::remove_all(path, ignored);
}

} // namespace

TemporaryDirectory::TemporaryDirectory() {
  const fs::path place = temporary_place();
  std::string name = (place / "frictab-XXXXXX").string();
  if (!mkdtemp(name.data()))
    throw InputError({"TMPDIR", 0, 0},
                     fmt::format("no temporary directory can be made in {}: {}", place.string(),
                                 std::strerror(errno)),
                     "set TMPDIR to a directory that can be written; unset, it is /tmp");
  path_ = name;
  when_interrupted_.emplace([path = path_] { remove_tree(path); });
}

TemporaryDirectory::~TemporaryDirectory() {
  remove_tree(path_);
}

} // namespace frictab
