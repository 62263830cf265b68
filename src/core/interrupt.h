// What Ctrl-C, a closed terminal or `kill` leave behind: nothing that nobody wants. Whoever makes a
// working file or starts a program says here how it is undone; a thread waits for the signal,
// undoes all of it, and lets the signal end the process as it would have.
#pragma once

#include <functional>

namespace frictab {

// Once, before any other thread is started. Without it WhenInterrupted does nothing.
void tidy_up_when_interrupted();

// While it lives, `undo` runs when the process is interrupted, in the thread that waits for the
// signal and beside what the others are doing; what was made last is undone first. It must not
// throw, nor make one of these itself.
class WhenInterrupted {
public:
  explicit WhenInterrupted(std::function<void()> undo);
  ~WhenInterrupted();
  WhenInterrupted(const WhenInterrupted&) = delete;
  WhenInterrupted& operator=(const WhenInterrupted&) = delete;
};

// While it lives, an interruption waits: a commit is not stopped in its midst.
class Uninterrupted {
public:
  Uninterrupted();
  ~Uninterrupted();
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;
};

} // namespace frictab
