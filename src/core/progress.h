// One progress line on stderr, for work that lasts over a second.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace frictab {

enum class ProgressStyle {
  off,
  line,  // drawn again in its place: a terminal
  lines, // one below the other, now and then: a log, or a terminal that cannot erase
};

// Off until switched on by the command line.
void show_progress(ProgressStyle style);

// A piece of work of `total` steps (0: how many is not known; 1 shows no steps), from construction
// to destruction; tick() from any thread. Work within other work is shown behind it: of several
// pieces at a time the one that began last. `before`: steps that an earlier run has done.
class Progress {
public:
  Progress(std::string title, std::size_t total, std::size_t before = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void tick(std::size_t steps = 1) const;

  struct Work;

private:
  std::shared_ptr<Work> work_;
};

// How far a piece of work is.
struct ProgressState {
  std::string title;
  std::size_t done = 0, total = 0, before = 0;
  double seconds = 0;
};

// The line for the outermost work and the one within it that is shown (or none), of at most `width`
// columns: where there is little room the bar goes first, then the end of the text.
std::string progress_text(const std::vector<ProgressState>& works, std::size_t width);

} // namespace frictab
