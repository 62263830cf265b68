// Draws the progress line from a thread of its own, first after one second.
#include "core/progress.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

#include <fmt/format.h>

namespace frictab {

namespace {
std::atomic<bool> enabled{false};
std::atomic<const void*> innermost{nullptr}; // is shown
} // namespace

void enable_progress(bool on) {
  enabled = on;
}

struct Progress::Line {
  std::string title;
  std::size_t total = 0;
  std::size_t before = 0;
  const void* outer = nullptr;
  std::atomic<std::size_t> done{0};
  std::mutex mutex;
  std::condition_variable wake;
  bool stop = false;
  std::thread thread;

  void draw(double seconds) const {
    constexpr std::size_t width = 30;
    const std::size_t now = std::min(done.load(), total);
    const std::size_t filled = total == 0 ? 0 : now * width / total;
    const std::size_t here = now - std::min(before, now);
    const double left =
        here == 0 ? 0 : seconds * static_cast<double>(total - now) / static_cast<double>(here);
    const std::string eta = here == 0 ? "" : fmt::format(", {:.0f} s left", left);
    fmt::print(stderr, "\r\x1b[K{} [{}{}] {}/{}, {:.0f} s{}", title, std::string(filled, '#'),
               std::string(width - filled, '.'), now, total, seconds, eta);
    std::fflush(stderr);
  }

  void run() {
    const auto begin = std::chrono::steady_clock::now();
    std::unique_lock lock(mutex);
    bool shown = false;
    auto wait = std::chrono::milliseconds(1000);
    while (!wake.wait_for(lock, wait, [&] { return stop; })) {
      wait = std::chrono::milliseconds(200);
      if (innermost != this) continue;
      draw(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
      shown = true;
    }
    if (shown) fmt::print(stderr, "\r\x1b[K");
  }
};

Progress::Progress(std::string title, std::size_t total, std::size_t before) {
  if (!enabled) return;
  line_ = std::make_unique<Line>();
  line_->title = std::move(title);
  line_->total = total;
  line_->before = before;
  line_->done = before;
  line_->outer = innermost.exchange(line_.get());
  line_->thread = std::thread([line = line_.get()] { line->run(); });
}

Progress::~Progress() {
  if (!line_) return;
  {
    const std::lock_guard lock(line_->mutex);
    line_->stop = true;
  }
  line_->wake.notify_one();
  line_->thread.join();
  innermost = line_->outer;
}

void Progress::tick(std::size_t steps) const {
  if (line_) line_->done += steps;
}

} // namespace frictab
