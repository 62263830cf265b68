// One progress line on stderr, for work that lasts over a second, on a terminal only.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace frictab {

// Off until switched on by the command line.
void enable_progress(bool on);

// A piece of work of `total` steps, from construction to destruction; tick() from any thread. One
// within another is shown instead of it. `before`: steps that an earlier run has done.
class Progress {
public:
  Progress(std::string title, std::size_t total, std::size_t before = 0);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void tick(std::size_t steps = 1) const;

private:
  struct Line;
  std::unique_ptr<Line> line_;
};

} // namespace frictab
