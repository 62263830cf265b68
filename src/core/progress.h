// One progress line on stderr, for work that lasts over a second, on a terminal only.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace frictab {

// Off until switched on by the command line.
void enable_progress(bool on);

// A piece of work of `total` steps, from construction to destruction; tick() from any thread. Only
// one at a time is shown.
class Progress {
public:
  Progress(std::string title, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void tick(std::size_t steps = 1);

private:
  struct Line;
  std::unique_ptr<Line> line_;
};

} // namespace frictab
