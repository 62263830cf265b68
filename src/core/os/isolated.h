// Readers that may crash, run in a child process under limits, which returns bytes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace frictab::os {

// Output of the child.
class ByteSink {
public:
  explicit ByteSink(int file) : file_(file) {}
  void write(std::span<const char> bytes);
  void number(std::uint64_t value);
  void text(const std::string& text);
  void doubles(std::span<const double> values);
  void flush();

private:
  int file_;
  std::string buffer_;
};

// Input of the parent: the child's output as it comes. Its functions return false if the output
// ends early or is waited for longer than `patience` in all; `text` also does if the length exceeds
// `most`.
class ByteSource {
public:
  explicit ByteSource(int file, std::chrono::milliseconds patience = std::chrono::minutes(1))
      : file_(file), patience_(patience) {}
  bool read(std::span<char> bytes);
  bool number(std::uint64_t& value);
  bool text(std::string& text, std::uint64_t most);
  bool doubles(std::span<double> values);
  bool has_ended(); // nothing more comes

private:
  bool wait();

  int file_;
  std::chrono::milliseconds patience_; // left
  std::string buffer_;
  std::size_t used_ = 0; // bytes of the buffer already read
};

struct ChildLimits {
  unsigned cpu_seconds = 10;
  unsigned wait_seconds = 60; // the parent waits in all: for a disk that hangs, or a pipe
  std::uint64_t memory_bytes = std::uint64_t{4} << 30; // on top of the parent's
};

// Limits for a child that reads a file of this size, on slow disks and processors too.
ChildLimits limits_to_read(std::uint64_t file_bytes);

// Runs `work` in a child while `take` runs here. Returns true if the child ended normally and
// `take` returned true. An exception of `take` is thrown here after the child has ended. `work`
// must not use locks that another thread may own.
bool run_isolated(const ChildLimits& limits, const std::function<void(ByteSink&)>& work,
                  const std::function<bool(ByteSource&)>& take);

} // namespace frictab::os
