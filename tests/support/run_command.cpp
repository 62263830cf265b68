// Child processes by posix_spawn, with both output streams read at once.
#include "support/run_command.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace frictab::test {

namespace {

namespace fs = std::filesystem;

void check(int error, const char* what) {
  if (error != 0) throw std::runtime_error(std::string(what) + ": " + std::strerror(error));
}

fs::path tests_directory() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

struct Pipe {
  std::array<int, 2> end{-1, -1};
  Pipe() { check(::pipe2(end.data(), O_CLOEXEC) == 0 ? 0 : errno, "pipe"); }
  ~Pipe() {
    close(0);
    close(1);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close(std::size_t which) {
    if (end[which] >= 0) ::close(end[which]);
    end[which] = -1;
  }
};

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> out;
  for (std::string& text : texts)
    out.push_back(text.data());
  out.push_back(nullptr);
  return out;
}

std::vector<std::string> merged(const std::vector<std::string>& changes) {
  std::map<std::string, std::string> all;
  const auto add = [&all](const std::string& entry) {
    all[entry.substr(0, entry.find('='))] = entry;
  };
  for (char** entry = environ; *entry; ++entry)
    add(*entry);
  for (const std::string& entry : changes)
    add(entry);
  std::vector<std::string> out;
  for (const auto& [name, entry] : all)
    out.push_back(entry);
  return out;
}

void read_both(Pipe& out, Pipe& err, CommandResult& result) {
  std::array<pollfd, 2> waits{{{out.end[0], POLLIN, 0}, {err.end[0], POLLIN, 0}}};
  std::array<std::string*, 2> texts{&result.out, &result.err};
  while (waits[0].fd >= 0 || waits[1].fd >= 0) {
    if (::poll(waits.data(), 2, -1) < 0) {
      if (errno == EINTR) continue;
      check(errno, "poll");
    }
    for (std::size_t i = 0; i < 2; ++i) {
      if (waits[i].fd < 0 || waits[i].revents == 0) continue;
      std::array<char, 65536> buffer;
      const ssize_t count = ::read(waits[i].fd, buffer.data(), buffer.size());
      if (count > 0)
        texts[i]->append(buffer.data(), static_cast<std::size_t>(count));
      else if (count == 0 || errno != EINTR)
        waits[i].fd = -1;
    }
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR) check(errno, "waitpid");
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

struct Actions {
  posix_spawn_file_actions_t it;
  Actions() { check(::posix_spawn_file_actions_init(&it), "posix_spawn_file_actions_init"); }
  ~Actions() { ::posix_spawn_file_actions_destroy(&it); }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;
};

} // namespace

CommandResult run_command(const std::vector<std::string>& argv, const std::string& directory,
                          const std::vector<std::string>& environment) {
  Pipe out, err;
  Actions actions;
  check(::posix_spawn_file_actions_addopen(&actions.it, 0, "/dev/null", O_RDONLY, 0), "stdin");
  check(::posix_spawn_file_actions_adddup2(&actions.it, out.end[1], 1), "stdout");
  check(::posix_spawn_file_actions_adddup2(&actions.it, err.end[1], 2), "stderr");
  if (!directory.empty())
    check(::posix_spawn_file_actions_addchdir_np(&actions.it, directory.c_str()), "chdir");
  std::vector<std::string> arguments = argv, variables = merged(environment);
  pid_t child = 0;
  check(::posix_spawnp(&child, argv.at(0).c_str(), &actions.it, nullptr, pointers(arguments).data(),
                       pointers(variables).data()),
        argv.at(0).c_str());
  out.close(1);
  err.close(1);
  CommandResult result;
  read_both(out, err, result);
  result.exit_code = wait_for(child);
  return result;
}

std::string program() {
  return tests_directory().parent_path() / "frictab";
}

std::string failing_disk() {
  return tests_directory() / "libfrictab_failing_disk.so";
}

CommandResult run_frictab(std::vector<std::string> arguments, const std::string& directory,
                          const std::vector<std::string>& environment) {
  arguments.insert(arguments.begin(), program());
  return run_command(arguments, directory, environment);
}

TemporaryDirectory::TemporaryDirectory() {
  std::string name = (fs::temp_directory_path() / "frictab-test-XXXXXX").string();
  if (!::mkdtemp(name.data())) check(errno, "mkdtemp");
  path_ = name;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryDirectory::path(const std::string& below) const {
  return below.empty() ? path_ : (fs::path(path_) / below).string();
}

std::string TemporaryDirectory::write(const std::string& file, const std::string& content) const {
  const fs::path target = path(file);
  fs::create_directories(target.parent_path());
  std::ofstream out(target, std::ios::binary);
  out << content;
  if (!out) throw std::runtime_error("cannot write " + target.string());
  return target.string();
}

std::string TemporaryDirectory::read(const std::string& file) const {
  std::ifstream in(path(file), std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path(file));
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

} // namespace frictab::test
