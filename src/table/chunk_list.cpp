// Lines of fixed length, each appended by one write.
#include "table/chunk_list.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>

#include <fcntl.h>
#include <fmt/format.h>
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

// Line by line until one is not whole; gives the bytes that are good.
std::size_t read_chunks(std::string_view text, std::string_view head, Chunks& found) {
  std::size_t good = text.starts_with(head) ? head.size() : 0;
  for (; good > 0 && good + line_length <= text.size(); good += line_length) {
    const std::string_view line = text.substr(good, line_length);
    std::size_t chunk = 0;
    std::uint64_t hash = 0;
    if (!parse(line.substr(0, 12), 10, chunk) || !parse(line.substr(13, 16), 16, hash)) break;
    found[chunk] = hash;
  }
  return good;
}

// Locks of the open file (fcntl, F_OFD_...): they end with the process, and can be asked for
// without being taken, so that shards that start together do not trip over each other.
struct flock whole_file() {
  struct flock lock = {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

bool lock(int file) {
  struct flock wanted = whole_file();
  const bool refused = ::fcntl(file, F_OFD_SETLK, &wanted) != 0;
  return !refused || (errno != EAGAIN && errno != EACCES);
}

bool is_locked(int file) {
  struct flock other = whole_file();
  return ::fcntl(file, F_OFD_GETLK, &other) == 0 && other.l_type != F_UNLCK;
}

} // namespace

ChunkList::ChunkList(const std::filesystem::path& file, const std::string& job)
    : name_(file), file_(::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666)) {
  if (file_ < 0)
    throw InputError({file.string(), 0, 0},
                     fmt::format("cannot be written: {}", std::strerror(errno)));
  if (!lock(file_)) {
    ::close(file_);
    throw InputError({file.string(), 0, 0}, "another frictab is writing this table",
                     "wait for it, or choose another directory with -o DIR");
  }
  const std::string text = io::read_file(file), head = job + "\n";
  const std::size_t good = read_chunks(text, head, found_);
  const bool cut = ::ftruncate(file_, static_cast<off_t>(good)) == 0;
  if (!cut || (good == 0 && ::write(file_, head.data(), head.size()) != ssize_t(head.size())))
    throw std::runtime_error("cannot write " + file.string());
}

bool in_use_for_another_job(const std::filesystem::path& file, const std::string& job) {
  const int list = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (list < 0) return false;
  const bool in_use = is_locked(list);
  ::close(list);
  return in_use && !io::read_file(file).starts_with(job + "\n");
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
