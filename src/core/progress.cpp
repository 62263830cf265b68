// Draws progress from a separate thread, which lives as long as there is work; the first line comes
// after one second.
#include "core/progress.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "core/os/interrupt.h"
#include "core/os/machine.h"
#include "core/os/standard_streams.h"

namespace frictab {

using Clock = std::chrono::steady_clock;

struct Progress::Work {
  std::string title;
  std::size_t total = 0, before = 0;
  std::atomic<std::size_t> done{0};
  Clock::time_point begin = Clock::now();

  ProgressState state() const {
    return {title, done.load(), total, before,
            std::chrono::duration<double>(Clock::now() - begin).count()};
  }
};

namespace {

std::atomic<ProgressStyle> style{ProgressStyle::off};

// All current work, and the thread that displays it.
class Display {
public:
  void add(std::shared_ptr<Progress::Work> work) {
    const std::lock_guard turn(turns_);
    if (!thread_.joinable()) {
      stop_ = false;
      tidy_.emplace([this] { erase_at_the_end(); });
      thread_ = std::thread([this] { run(); });
    }
    const std::lock_guard lock(mutex_);
    works_.push_back(std::move(work));
  }

  void remove(const std::shared_ptr<Progress::Work>& work) {
    const std::lock_guard turn(turns_);
    {
      const std::lock_guard lock(mutex_);
      std::erase(works_, work);
      if (!works_.empty()) return;
      stop_ = true;
    }
    wake_.notify_all();
    thread_.join();
    tidy_.reset();
  }

private:
  void run() {
    const bool in_place = style == ProgressStyle::line;
    const auto pause = in_place ? std::chrono::milliseconds(200) : std::chrono::milliseconds(10000);
    auto wait = std::chrono::milliseconds(1000);
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, wait, [&] { return stop_; })) {
      wait = pause;
      if (!works_.empty()) draw(in_place);
    }
    erase();
  }

  void draw(bool in_place) {
    std::vector<ProgressState> states{works_.front()->state()};
    if (works_.size() > 1) states.push_back(works_.back()->state());
    // Most terminals wrap a line that fills the last column.
    const std::string text = progress_text(states, os::terminal_width() - 1);
    os::put(stderr, in_place ? "\r\x1b[K" + text : text + "\n");
    std::fflush(stderr);
    drawn_ = in_place;
  }

  void erase() {
    if (!drawn_) return;
    os::put(stderr, "\r\x1b[K");
    std::fflush(stderr);
    drawn_ = false;
  }

  // Erases the line before an interrupted program reports what it leaves; draws nothing afterwards.
  void erase_at_the_end() {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    erase();
  }

  std::mutex turns_; // guards the start and the end of the thread
  std::mutex mutex_; // guards the members below; its owner never blocks
  std::condition_variable wake_;
  std::vector<std::shared_ptr<Progress::Work>> works_; // outermost first
  std::optional<os::WhenInterrupted> tidy_;
  std::thread thread_;
  bool stop_ = false, drawn_ = false;
};

Display& display() {
  static Display it;
  return it;
}

std::string count_text(const ProgressState& work) {
  if (work.total == 0) return work.done == 0 ? "" : fmt::format(" {}", work.done);
  if (work.total == 1) return "";
  return fmt::format(" {}/{}", std::min(work.done, work.total), work.total);
}

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (whole < 100) return fmt::format("{} s", whole);
  if (whole < 6000) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

// Estimated time left from the duration of the steps so far; "" before the first one.
std::string left_text(const ProgressState& work) {
  const std::size_t done = std::min(work.done, work.total);
  const std::size_t here = done - std::min(work.before, done);
  if (here == 0) return "";
  return fmt::format(", {} left", time_text(work.seconds * static_cast<double>(work.total - done) /
                                            static_cast<double>(here)));
}

std::string bar_text(const ProgressState& work, std::size_t width) {
  const std::size_t filled = std::min(work.done, work.total) * width / work.total;
  return fmt::format(" [{}{}]", std::string(filled, '#'), std::string(width - filled, '.'));
}

} // namespace

std::string progress_text(const std::vector<ProgressState>& works, std::size_t width) {
  constexpr std::size_t widest_bar = 30, narrowest_bar = 5, brackets = 3;
  const ProgressState& inner = works.back();
  std::string before;
  if (works.size() > 1)
    before = works.front().title + count_text(works.front()) + ": " + inner.title;
  else
    before = inner.title;
  std::string behind = count_text(inner);
  behind += ", " + time_text(works.front().seconds);
  const bool has_steps = inner.total > 1;
  if (has_steps) behind += left_text(inner);
  std::string bar;
  const std::size_t taken = before.size() + behind.size() + brackets;
  if (has_steps && taken + narrowest_bar <= width)
    bar = bar_text(inner, std::min(widest_bar, width - taken));
  std::string line = before + bar + behind;
  if (line.size() > width) line.resize(width);
  return line;
}

void show_progress(ProgressStyle how) {
  style = how;
}

Progress::Progress(std::string title, std::size_t total, std::size_t before) {
  if (style == ProgressStyle::off) return;
  work_ = std::make_shared<Work>();
  work_->title = std::move(title);
  work_->total = total;
  work_->before = before;
  work_->done = before;
  display().add(work_);
}

Progress::~Progress() {
  if (work_) display().remove(work_);
}

void Progress::tick(std::size_t steps) const {
  if (work_) work_->done += steps;
}

} // namespace frictab
