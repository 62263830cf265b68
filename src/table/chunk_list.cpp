// Lines of fixed length, each appended by one write.
#include "table/chunk_list.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "core/error.h"
#include "io/atomic_file.h"

namespace frictab::table {

namespace {

constexpr std::size_t line_length = 12 + 1 + 16 + 1;

std::string line_of(std::size_t chunk, std::uint64_t hash) {
  return fmt::format("{:012} {:016x}\n", chunk, hash);
}

template <class T> bool parse(std::string_view text, int base, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc() && end == text.data() + text.size();
}

} // namespace

ChunkList::ChunkList(const std::filesystem::path& file, const std::string& job)
    : name_(file), file_(::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_ < 0)
    throw InputError({file.string(), 0, 0},
                     fmt::format("cannot be written: {}", std::strerror(errno)));
  if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
    ::close(file_);
    throw InputError({file.string(), 0, 0}, "another frictab is writing this table",
                     "wait for it, or choose another directory with -o DIR");
  }
  const std::string text = io::read_file(file), head = job + "\n";
  std::size_t good = text.starts_with(head) ? head.size() : 0;
  for (; good > 0 && good + line_length <= text.size(); good += line_length) {
    const std::string_view line = std::string_view(text).substr(good, line_length);
    std::size_t chunk = 0;
    std::uint64_t hash = 0;
    if (!parse(line.substr(0, 12), 10, chunk) || !parse(line.substr(13, 16), 16, hash)) break;
    found_[chunk] = hash;
  }
  const bool cut = ::ftruncate(file_, static_cast<off_t>(good)) == 0;
  if (!cut || (good == 0 && ::write(file_, head.data(), head.size()) != ssize_t(head.size())))
    throw std::runtime_error("cannot write " + file.string());
}

ChunkList::~ChunkList() {
  ::close(file_);
}

void ChunkList::add(std::size_t chunk, std::uint64_t hash) const {
  const std::string line = line_of(chunk, hash);
  if (::write(file_, line.data(), line.size()) != ssize_t(line.size()))
    throw InputError({name_.string(), 0, 0},
                     fmt::format("cannot be written: {}", std::strerror(errno)));
}

} // namespace frictab::table
