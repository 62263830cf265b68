// A child process with a pipe and resource limits.
#include "core/os/isolated.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/os/limit.h"

namespace frictab::os {

namespace {

constexpr std::size_t buffered = std::size_t{1} << 16;

void write_all(int file, std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(file, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) ::_exit(1); // the parent has gone
    bytes = bytes.subspan(static_cast<std::size_t>(put));
  }
}

// Virtual memory that this process already uses and a limit therefore has to include.
std::uint64_t own_memory() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void run_in_child(const ChildLimits& limits, int out,
                               const std::function<void(ByteSink&)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL); // dies with the parent, its only reader
  sigset_t none;                      // the child has no thread that waits for signals
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDERR_FILENO); // hides the last words of a sanitizer or the C library
  set_limit(RLIMIT_CORE, 0);
  set_limit(RLIMIT_CPU, limits.cpu_seconds); // stops endless loops caused by a damaged file
  set_limit(RLIMIT_AS, own_memory() + limits.memory_bytes);
  try {
    ByteSink sink(out);
    work(sink);
    sink.flush();
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

// Kills and reaps the child on every path.
class Child {
public:
  Child(pid_t id, int from) : id_(id), from_(from) {}
  ~Child() {
    if (id_ > 0) ::kill(id_, SIGKILL);
    end();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  bool end() {
    if (id_ <= 0) return false;
    ::close(from_);
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = 0;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

private:
  pid_t id_;
  int from_;
};

} // namespace

void ByteSink::write(std::span<const char> bytes) {
  buffer_.append(bytes.data(), bytes.size());
  if (buffer_.size() >= buffered) flush();
}

void ByteSink::number(std::uint64_t value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  write(bytes);
}

void ByteSink::text(const std::string& text) {
  number(text.size());
  write(text);
}

void ByteSink::doubles(std::span<const double> values) {
  flush();
  write_all(file_, {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

void ByteSink::flush() {
  write_all(file_, buffer_);
  buffer_.clear();
}

bool ByteSource::read(std::span<char> bytes) {
  while (!bytes.empty()) {
    if (used_ < buffer_.size()) {
      const std::size_t part = std::min(bytes.size(), buffer_.size() - used_);
      buffer_.copy(bytes.data(), part, used_);
      used_ += part;
      bytes = bytes.subspan(part);
      continue;
    }
    if (!wait()) return false;
    const bool small = bytes.size() < buffered;
    if (small) buffer_.resize(buffered);
    const ssize_t got =
        ::read(file_, small ? buffer_.data() : bytes.data(), small ? buffer_.size() : bytes.size());
    if (small) buffer_.resize(static_cast<std::size_t>(std::max<ssize_t>(got, 0))), used_ = 0;
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    if (!small) bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
  return true;
}

bool ByteSource::wait() {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  constexpr milliseconds longest{1 << 30}; // of poll
  pollfd output{file_, POLLIN, 0};
  int ready = -1;
  do {
    const auto begin = Clock::now();
    ready = ::poll(&output, 1,
                   static_cast<int>(std::clamp(patience_, milliseconds(0), longest).count()));
    patience_ -= std::chrono::duration_cast<milliseconds>(Clock::now() - begin);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

bool ByteSource::has_ended() {
  char more = 0;
  return !read({&more, 1}) && patience_ > std::chrono::milliseconds(0);
}

bool ByteSource::number(std::uint64_t& value) {
  char bytes[sizeof value];
  if (!read(bytes)) return false;
  std::memcpy(&value, bytes, sizeof value);
  return true;
}

bool ByteSource::text(std::string& text, std::uint64_t most) {
  std::uint64_t size = 0;
  if (!number(size) || size > most) return false;
  text.resize(size);
  return read(text);
}

bool ByteSource::doubles(std::span<double> values) {
  return read({reinterpret_cast<char*>(values.data()), values.size_bytes()});
}

ChildLimits limits_to_read(std::uint64_t file_bytes) {
  ChildLimits limits;
  limits.cpu_seconds += static_cast<unsigned>(file_bytes >> 22);
  limits.wait_seconds += static_cast<unsigned>(file_bytes >> 19);
  return limits;
}

bool run_isolated(const ChildLimits& limits, const std::function<void(ByteSink&)>& work,
                  const std::function<bool(ByteSource&)>& take) {
  int ends[2] = {};
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe can be had");
  ::fcntl(ends[1], F_SETPIPE_SZ, 1 << 20); // fewer system calls; the usual size works as well
  const pid_t id = ::fork();
  if (id < 0) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw std::runtime_error("no process can be started");
  }
  if (id == 0) {
    ::close(ends[0]);
    run_in_child(limits, ends[1], work);
  }
  ::close(ends[1]);
  Child child(id, ends[0]);
  ByteSource source(ends[0], std::chrono::seconds(limits.wait_seconds));
  return take(source) && source.has_ended() && child.end();
}

} // namespace frictab::os
