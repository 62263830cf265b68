// A progress line on stderr, for work that lasts more than a second.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace frictab {

enum class ProgressStyle {
  off,
  line,  // redrawn in place: a terminal
  lines, // a new line now and then: a log, or a terminal that cannot erase
};

// Sets the style. The default is off; the command line switches it on.
void show_progress(ProgressStyle style);

// A piece of work of `total` steps (0: number unknown; 1: shows no steps), from construction to
// destruction; tick() may be called from any thread. Nested work is shown after the outer one; of
// several pieces at a time only the latest is shown. `before`: steps completed by an earlier run.
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

// Progress of one piece of work.
struct ProgressState {
  std::string title;
  std::size_t done = 0, total = 0, before = 0;
  double seconds = 0;
};

// The line for the outermost work and the nested one that is shown (or none), at most `width`
// columns wide: if space is short the bar is dropped first, then the end of the text.
std::string progress_text(const std::vector<ProgressState>& works, std::size_t width);

} // namespace frictab
