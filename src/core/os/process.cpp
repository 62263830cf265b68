// Runs programs by vfork and exec: posix_spawn cannot limit memory before the program begins.
#include "core/os/process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/os/files.h"
#include "core/os/interrupt.h"
#include "core/os/limit.h"

extern char** environ;

namespace frictab::os {

namespace fs = std::filesystem;

namespace {

constexpr int pause_ms = 1; // between two looks whether a program has ended
constexpr std::size_t kept_at_each_end = 4000;
constexpr std::uint64_t largest_file_bytes = std::uint64_t{2} << 30; // that a program may write

using Entries = std::vector<std::string>;

// Empty entries count: in most lists they mean the working directory.
Entries entries_of(std::string_view list, const char* separators) {
  Entries entries;
  while (true) {
    const std::size_t end = *separators ? list.find_first_of(separators) : list.npos;
    entries.emplace_back(list.substr(0, end));
    if (end == list.npos) return entries;
    list.remove_prefix(end + 1);
  }
}

bool is_safe(const std::string& directory) {
  struct stat there {
  }, here{};
  if (!directory.starts_with('/') || ::stat(directory.c_str(), &there) != 0) return false;
  if (there.st_mode & S_IWOTH) return false;
  return ::stat(".", &here) != 0 || there.st_dev != here.st_dev || there.st_ino != here.st_ino;
}

Entries safe_path() {
  const char* const path = std::getenv("PATH");
  Entries entries = entries_of(path ? path : "/bin:/usr/bin", ":");
  std::erase_if(entries, [](const std::string& directory) { return !is_safe(directory); });
  return entries;
}

// Lists of folders and files from which the dynamic linker, gcc and clang take code: libraries,
// parts of a compiler, headers.
struct CodeList {
  std::string_view name;
  const char* separators; // "": a single name
  bool has_names = false; // an entry without '/' is looked for in the folders of other lists
};

constexpr CodeList code_lists[] = {
    {"LD_LIBRARY_PATH", ":;"}, {"LD_PRELOAD", ": ", true}, {"LD_AUDIT", ":", true},
    {"LD_RUN_PATH", ":"},      {"GCONV_PATH", ":"},        {"GCC_EXEC_PREFIX", ""},
    {"COMPILER_PATH", ":"},    {"LIBRARY_PATH", ":"},      {"CPATH", ":"},
    {"C_INCLUDE_PATH", ":"},
};

Entries absolute_entries(const CodeList& list, std::string_view value) {
  Entries entries = entries_of(value, list.separators);
  std::erase_if(entries, [&](const std::string& entry) {
    const bool is_name = list.has_names && !entry.empty() && entry.find('/') == std::string::npos;
    return !entry.starts_with('/') && !is_name;
  });
  return entries;
}

// An empty list would mean the working directory: without entries the variable is left out.
void add_list(std::vector<std::string>& environment, std::string_view name,
              const Entries& entries) {
  std::string text(name);
  for (const std::string& entry : entries)
    text += (&entry == &entries.front() ? "=" : ":") + entry;
  if (!entries.empty()) environment.push_back(std::move(text));
}

class Pipe {
public:
  Pipe() {
    if (::pipe2(ends_, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be had");
  }
  ~Pipe() {
    close_writing();
    ::close(ends_[0]);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void close_writing() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

private:
  int ends_[2] = {-1, -1};
};

// Everything that a child needs, made before it exists: it shares the memory of this process until
// exec.
struct Start {
  const char* file;
  char* const* argv;
  char* const* environment;
  const char* directory;
  int output;
  std::uint64_t memory_bytes;
};

[[noreturn]] void become(const Start& start, volatile int& error) noexcept {
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_DATA, start.memory_bytes); // memory, not the address space that some reserve
  set_limit(RLIMIT_FSIZE, largest_file_bytes);
  sigset_t none; // the child has no thread that waits for signals (interrupt.h)
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  for (const int signal : {SIGPIPE, SIGXFSZ}) // this process ignores them (standard_streams.h)
    std::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (nothing >= 0 && ::dup2(nothing, STDIN_FILENO) >= 0 &&
      ::dup2(start.output, STDOUT_FILENO) >= 0 && ::dup2(start.output, STDERR_FILENO) >= 0 &&
      ::setpgid(0, 0) == 0 && ::chdir(start.directory) == 0) {
    if (nothing > STDERR_FILENO) ::close(nothing);
    ::execve(start.file, start.argv, start.environment);
  }
  error = errno;
  ::_exit(127);
}

// Sets `error` if the program cannot be started; the child has then ended.
pid_t start_child(const Start& start, volatile int& error) {
  const pid_t child = ::vfork();
  if (child == 0) become(start, error);
  if (child < 0) error = errno;
  return child;
}

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (const std::string& text : texts)
    out.push_back(const_cast<char*>(text.c_str()));
  out.push_back(nullptr);
  return out;
}

// Reads the output of a child, so that no flood of it reaches the disk.
class Output {
public:
  Output(int file, ProcessResult& result) : file_(file), result_(result) {}

  // Reads a part if there is one within `wait_ms`, at most as much as a pipe holds.
  void read(int wait_ms) {
    pollfd waits{file_, POLLIN, 0};
    if (::poll(&waits, 1, wait_ms) <= 0) return;
    const ssize_t got = ::read(file_, buffer_.data(), buffer_.size());
    if (got > 0)
      add({buffer_.data(), static_cast<std::size_t>(got)});
    else if (got == 0 || errno != EINTR)
      file_ = -1; // poll then only waits
  }

private:
  void add(std::string_view part) {
    result_.bytes += part.size();
    const std::size_t first = std::min(part.size(), kept_at_each_end - result_.beginning.size());
    result_.beginning += part.substr(0, first);
    result_.end += part.substr(first);
    if (result_.end.size() > kept_at_each_end)
      result_.end.erase(0, result_.end.size() - kept_at_each_end);
  }

  int file_;
  ProcessResult& result_;
  std::string buffer_ = std::string(std::size_t{1} << 16, '\0');
};

// Exit status; nullopt if the child does not end in time.
std::optional<int> wait_for(pid_t child, Output& output, std::chrono::seconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (true) {
    output.read(pause_ms);
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) throw std::runtime_error("lost a program while it ran");
    if (std::chrono::steady_clock::now() > end) return std::nullopt;
  }
}

} // namespace

std::string on_path(const std::string& program) {
  for (const std::string& directory : safe_path()) {
    const fs::path file = fs::path(directory) / program;
    std::error_code error;
    if (fs::is_regular_file(file, error) && may_run(file)) return file.string();
  }
  return "";
}

std::vector<std::string> environment_for_programs() {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry; ++entry) {
    const std::string_view text = *entry, name = text.substr(0, text.find('='));
    const auto list = std::find_if(std::begin(code_lists), std::end(code_lists),
                                   [&](const CodeList& one) { return one.name == name; });
    if (list != std::end(code_lists) && name.size() < text.size())
      add_list(environment, name, absolute_entries(*list, text.substr(name.size() + 1)));
    else if (name != "PATH")
      environment.emplace_back(text);
  }
  add_list(environment, "PATH", safe_path());
  return environment;
}

ProcessResult run_process(const std::vector<std::string>& command, const fs::path& directory,
                          const ProcessLimits& limits) {
  const bool named = command[0].find('/') == std::string::npos;
  const std::string file = named ? on_path(command[0]) : command[0];
  if (file.empty())
    throw std::runtime_error("cannot run " + command[0] +
                             ": it is in no folder of PATH, or only in one that is relative, the "
                             "working directory or writable by everybody");
  if (!may_run(file))
    throw std::runtime_error("cannot run " + command[0] + ": " + std::strerror(errno));
  std::vector<std::string> words = command;
  words[0] = file;
  const std::vector<std::string> environment = environment_for_programs();
  const std::vector<char*> argv = pointers_to(words), variables = pointers_to(environment);
  ProcessResult result;
  Pipe pipe;
  volatile int failed = 0;
  const pid_t child = start_child({file.c_str(), argv.data(), variables.data(), directory.c_str(),
                                   pipe.writing(), limits.memory_bytes},
                                  failed);
  pipe.close_writing();
  if (failed != 0) {
    if (child > 0) ::waitpid(child, nullptr, 0);
    throw std::runtime_error("cannot run " + command[0] + ": " + std::strerror(failed));
  }
  const WhenInterrupted killed([child] { ::kill(-child, SIGKILL); });
  Output output(pipe.reading(), result);
  const std::optional<int> status = wait_for(child, output, limits.time);
  ::kill(-child, SIGKILL); // kills the processes it has started as well
  if (!status) ::waitpid(child, nullptr, 0);
  output.read(0); // all that the pipe still holds
  if (!status)
    result.ended = Ended::too_late;
  else if (WIFEXITED(*status) && WEXITSTATUS(*status) == 0)
    result.ended = Ended::well;
  return result;
}

} // namespace frictab::os
