// forkpty: the child's terminal, of which the parent reads what is written.
#include "support/terminal.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

namespace frictab::test {

namespace {

[[noreturn]] void become(std::vector<std::string> argv, const std::string& directory,
                         std::vector<std::string> environment) {
  std::vector<char*> words;
  for (std::string& word : argv)
    words.push_back(word.data());
  words.push_back(nullptr);
  for (std::string& entry : environment)
    ::putenv(entry.data());
  if (::chdir(directory.c_str()) == 0) ::execvp(words[0], words.data());
  ::_exit(127);
}

std::string read_all(int terminal, const std::string& interrupt_at) {
  std::string text;
  bool interrupted = interrupt_at.empty();
  std::array<char, 4096> buffer;
  while (true) {
    const ssize_t count = ::read(terminal, buffer.data(), buffer.size());
    if (count > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
      if (!interrupted && text.find(interrupt_at) != text.npos)
        interrupted = ::write(terminal, "\x03", 1) == 1;
    }
    if (count == 0 || (count < 0 && errno != EINTR)) // EIO: the program has ended
      return text;
  }
}

} // namespace

CommandResult run_on_terminal(const std::vector<std::string>& argv, unsigned columns,
                              const std::string& directory,
                              const std::vector<std::string>& environment,
                              const std::string& interrupt_at) {
  const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
  int terminal = -1;
  const pid_t child = ::forkpty(&terminal, nullptr, nullptr, &size);
  if (child < 0) throw std::runtime_error(std::string("forkpty: ") + std::strerror(errno));
  if (child == 0) become(argv, directory, environment);
  CommandResult result;
  result.out = read_all(terminal, interrupt_at);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  ::close(terminal);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

} // namespace frictab::test
