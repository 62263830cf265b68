// Reading what may bring down its reader: in a child process, under limits, which hands over bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace frictab::io {

// Where the child writes to.
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

// What the parent takes from it, as it comes. Ends early where the child does; a length that is
// larger than `most` is no length.
class ByteSource {
public:
  explicit ByteSource(int file) : file_(file) {}
  bool read(std::span<char> bytes);
  bool number(std::uint64_t& value);
  bool text(std::string& text, std::uint64_t most);
  bool doubles(std::span<double> values);

private:
  int file_;
  std::string buffer_;
  std::size_t used_ = 0; // of the buffer
};

struct ChildLimits {
  unsigned cpu_seconds = 10;
  std::uint64_t memory_bytes = std::uint64_t{4} << 30; // beside what the parent has
};

// Runs `work` in a child while `take` runs here. True where the child ended well, and take said so
// too. What take throws is thrown here, with the child gone. `work` is not to touch locks that
// another thread may hold.
bool run_isolated(const ChildLimits& limits, const std::function<void(ByteSink&)>& work,
                  const std::function<bool(ByteSource&)>& take);

} // namespace frictab::io
