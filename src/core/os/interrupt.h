// Cleanup on SIGINT, SIGHUP and SIGTERM. Code that creates a working file or starts a program
// registers here how to undo it; a thread waits for the signal, undoes everything, and lets the
// signal end the process as it would have.
#pragma once

#include <functional>

namespace frictab::os {

// Starts the waiting thread; call once, before any other thread starts. Without it WhenInterrupted
// does nothing.
void tidy_up_when_interrupted();

// Runs `undo` if the process is interrupted during this object's lifetime. It runs in the thread
// that waits for the signal, concurrently with all other threads; the latest registration is undone
// first. `undo` must not throw and must not create a WhenInterrupted.
class WhenInterrupted {
public:
  explicit WhenInterrupted(std::function<void()> undo);
  ~WhenInterrupted();
  WhenInterrupted(const WhenInterrupted&) = delete;
  WhenInterrupted& operator=(const WhenInterrupted&) = delete;
};

// Delays an interruption during this object's lifetime, so that a commit is not stopped halfway.
class Uninterrupted {
public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};

} // namespace frictab::os
