// pread and pwrite behind two small classes.
#include "io/stored_values.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"
#include "core/parallel.h"
#include "core/text.h"

namespace frictab::io {

namespace fs = std::filesystem;

StoredValues::StoredValues(const fs::path& file, std::string named, std::uint64_t offset,
                           std::size_t size)
    : named_(std::move(named)), offset_(offset), size_(size),
      file_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (file_ < 0)
    throw InputError({named_, 0, 0}, fmt::format("cannot be opened: {}", std::strerror(errno)));
}

StoredValues::~StoredValues() {
  ::close(file_);
}

void StoredValues::read(std::size_t first, std::span<double> values) const {
  auto* to = reinterpret_cast<char*>(values.data());
  std::size_t left = values.size_bytes();
  auto at = static_cast<off_t>(offset_ + sizeof(double) * first);
  while (left > 0) {
    const ssize_t got = ::pread(file_, to, left, at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0)
      throw InputError({named_, 0, 0},
                       fmt::format("cannot be read at byte {}: {}", at, std::strerror(errno)));
    if (got == 0)
      throw InputError({named_, 0, 0}, fmt::format("ends at byte {}, within its values", at),
                       "it was cut short: write it again, or take a copy");
    to += got;
    at += got;
    left -= static_cast<std::size_t>(got);
  }
}

std::size_t StoredValues::first_not_between(double above, double below) const {
  constexpr std::size_t block = std::size_t{1} << 17;
  std::atomic<std::size_t> found{size_};
  parallel_for((size_ + block - 1) / block, [&](std::size_t b) {
    if (b * block > found) return;
    std::vector<double> values(std::min(block, size_ - b * block));
    read(b * block, values);
    const auto at =
        static_cast<std::size_t>(std::find_if(values.begin(), values.end(),
                                              [&](double v) { return !(v > above && v < below); }) -
                                 values.begin());
    if (at == values.size()) return;
    std::size_t least = found;
    while (b * block + at < least && !found.compare_exchange_weak(least, b * block + at)) {
    }
  });
  return found;
}

namespace {

[[noreturn]] void cannot_write(const fs::path& file) {
  const int error = errno;
  throw InputError({file.string(), 0, 0},
                   fmt::format("cannot be written: {}", std::strerror(error)),
                   error == ENOSPC ? "make room on the disk: what is finished is kept" : "");
}

} // namespace

ValuesFile::ValuesFile(const fs::path& file, std::uint64_t offset, std::size_t size)
    : name_(file), offset_(offset),
      file_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ < 0) cannot_write(name_);
  resize(offset + sizeof(double) * size);
}

ValuesFile::~ValuesFile() {
  ::close(file_);
}

void ValuesFile::resize(std::uint64_t bytes) const {
  if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) cannot_write(name_);
}

void ValuesFile::write(std::size_t first, std::span<const double> values) const {
  write_bytes(offset_ + sizeof(double) * first,
              {reinterpret_cast<const char*>(values.data()), values.size_bytes()});
}

void ValuesFile::write_bytes(std::uint64_t at, std::span<const char> bytes) const {
  while (!bytes.empty()) {
    const ssize_t put = ::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) cannot_write(name_);
    at += static_cast<std::uint64_t>(put);
    bytes = bytes.subspan(static_cast<std::size_t>(put));
  }
}

void check_disk_space(const fs::path& directory, std::uint64_t bytes, const std::string& what,
                      const std::string& hint) {
  fs::path there = fs::absolute(directory);
  while (!fs::exists(there) && there.has_relative_path())
    there = there.parent_path();
  std::error_code error;
  const fs::space_info space = fs::space(there, error);
  if (error || bytes <= space.available) return;
  throw InputError({directory.string(), 0, 0},
                   fmt::format("{} needs {} on disk, {} are free", what,
                               human_bytes(static_cast<double>(bytes)),
                               human_bytes(static_cast<double>(space.available))),
                   hint);
}

} // namespace frictab::io
