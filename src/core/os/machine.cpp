// Asks sysconf, getrusage and ioctl.
#include "core/os/machine.h"

#include <cmath>

#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace frictab::os {

double machine_memory() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGE_SIZE));
}

double stack_limit() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_STACK, &limit) == 0 ? static_cast<double>(limit.rlim_cur) : HUGE_VAL;
}

double peak_memory() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

bool is_terminal(std::FILE* stream) {
  return ::isatty(::fileno(stream)) != 0;
}

std::size_t terminal_width() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0 ? 80 : size.ws_col;
}

int process_id() {
  return ::getpid();
}

std::string host_name() {
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  return host;
}

} // namespace frictab::os
