// The list of undo functions, and the thread that waits for signals.
#include "core/os/interrupt.h"

#include <algorithm>
#include <csignal>
#include <latch>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <unistd.h>

namespace frictab::os {

namespace {

struct ToUndo {
  std::mutex mutex; // locked during a commit and by the thread that undoes
  std::vector<std::pair<const WhenInterrupted*, std::function<void()>>> all;
};

ToUndo& to_undo() {
  static auto* const list = new ToUndo; // never destroyed: the thread may outlive main
  return *list;
}

sigset_t interruptions() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    sigaddset(&signals, signal);
  return signals;
}

[[noreturn]] void end_by(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, signal);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  ::kill(::getpid(), signal);
  ::_exit(128 + signal);
}

// Lets a fork wait until the thread runs: a starting thread allocates, and in a process forked
// meanwhile (isolated.h) the allocator's lock would stay locked forever unless the allocator
// releases it in the child. glibc's does; that of AddressSanitizer (GCC 12) does not.
std::latch& thread_has_started() {
  static std::latch started(1); // outlives the threads that wait on it or count it down
  return started;
}

void wait_for_interruption() {
  const sigset_t signals = interruptions();
  ToUndo& list = to_undo();
  thread_has_started().count_down();
  int signal = 0;
  if (sigwait(&signals, &signal) != 0) return;
  const std::lock_guard lock(list.mutex); // never released
  for (auto at = list.all.rbegin(); at != list.all.rend(); ++at)
    at->second();
  end_by(signal);
}

} // namespace

void tidy_up_when_interrupted() {
  sigset_t signals = interruptions();
  // Signals that nohup or a shell's background job ignores stay ignored.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN)
      sigdelset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(wait_for_interruption).detach();
  thread_has_started().wait();
}

WhenInterrupted::WhenInterrupted(std::function<void()> undo) {
  ToUndo& list = to_undo();
  const std::lock_guard lock(list.mutex);
  list.all.emplace_back(this, std::move(undo));
}

WhenInterrupted::~WhenInterrupted() {
  ToUndo& list = to_undo();
  const std::lock_guard lock(list.mutex);
  std::erase_if(list.all, [&](const auto& one) { return one.first == this; });
}

Uninterrupted::Uninterrupted() {
  to_undo().mutex.lock();
}

Uninterrupted::~Uninterrupted() {
  to_undo().mutex.unlock();
}

} // namespace frictab::os
