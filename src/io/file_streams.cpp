// Buffers that pass on what the operating system says.
#include "io/file_streams.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/hash.h"
#include "core/text.h"

namespace frictab::io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 16;

[[noreturn]] void cannot_read(const std::string& named, const std::error_code& why) {
  throw std::runtime_error(fmt::format("{} cannot be read: {}", named, why.message()));
}

[[noreturn]] void cannot_open(const std::string& named, const std::error_code& why) {
  if (why == std::errc::no_such_file_or_directory || why == std::errc::not_a_directory)
    throw InputError({named, 0, 0}, "no such file");
  if (why == std::errc::permission_denied)
    throw InputError({named, 0, 0}, "cannot be read", "check its permissions");
  if (is_fault_of_path(why)) throw InputError({named, 0, 0}, why.message());
  cannot_read(named, why);
}

os::FileToRead opened(const fs::path& path, const std::string& named) {
  try {
    return os::FileToRead(path); // not copied
  } catch (const std::system_error& error) {
    cannot_open(named, error.code());
  }
}

[[noreturn]] void cannot_write(const fs::path& path, const std::error_code& why) {
  throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), why.message()));
}

} // namespace

class InputFile::Buffer : public std::streambuf {
public:
  Buffer(const fs::path& path, std::string named, std::uint64_t most)
      : file_(opened(path, named)), named_(std::move(named)), most_(most) {
    using Kind = os::FileToRead::Kind;
    if (file_.kind() == Kind::directory)
      throw InputError({named_, 0, 0}, "is a directory, a file is needed");
    if (file_.kind() != Kind::file)
      throw InputError({named_, 0, 0}, "is a pipe or a device, a file is needed",
                       "write what comes out of it to a file first");
    check_size(file_.state().bytes);
  }

  const os::FileState& state() const { return file_.state(); }

  std::size_t read_at(std::uint64_t at, std::span<char> bytes) const {
    try {
      const std::size_t got = file_.read(at, bytes);
      check_size(at + got);
      return got;
    } catch (const std::system_error& error) {
      cannot_read(named_, error.code());
    }
  }

protected:
  int_type underflow() override {
    const std::size_t got = next(piece_);
    setg(piece_.data(), piece_.data(), piece_.data() + got);
    return got == 0 ? traits_type::eof() : traits_type::to_int_type(piece_.front());
  }

  std::streamsize xsgetn(char* to, std::streamsize count) override {
    const auto wanted = static_cast<std::size_t>(count);
    std::size_t done = std::min(wanted, static_cast<std::size_t>(egptr() - gptr()));
    std::memcpy(to, gptr(), done);
    setg(eback(), gptr() + done, egptr());
    if (done < wanted) done += next({to + done, wanted - done});
    return static_cast<std::streamsize>(done);
  }

private:
  void check_size(std::uint64_t bytes) const {
    if (bytes > most_)
      throw InputError({named_, 0, 0}, "is larger than " + human_bytes(static_cast<double>(most_)));
  }

  std::size_t next(std::span<char> bytes) {
    const std::size_t got = read_at(at_, bytes);
    at_ += got;
    return got;
  }

  os::FileToRead file_;
  std::string named_;
  std::uint64_t most_;
  std::uint64_t at_ = 0; // offset of what is read next
  std::array<char, piece_bytes> piece_;
};

InputFile::InputFile(const fs::path& path, const std::string& named, std::uint64_t most)
    : std::istream(nullptr), buffer_(std::make_unique<Buffer>(path, named, most)) {
  rdbuf(buffer_.get());
  exceptions(std::ios::badbit); // the buffer's own exceptions come through
}

InputFile::~InputFile() = default;

std::uint64_t InputFile::size() const {
  return buffer_->state().bytes;
}

const os::FileState& InputFile::state() const {
  return buffer_->state();
}

std::size_t InputFile::read_at(std::uint64_t at, std::span<char> bytes) {
  return buffer_->read_at(at, bytes);
}

class OutputFile::Buffer : public std::streambuf {
public:
  explicit Buffer(const fs::path& path) : path_(path) {
    checked([&] { file_ = std::make_unique<os::FileToWrite>(path); });
    setp(piece_.data(), piece_.data() + piece_.size());
  }

  void finish() {
    flush();
    checked([&] { file_->close(); });
    if (hash_of_file(path_, path_.string()) != hash_.value())
      throw std::runtime_error("the disk gives back something else than was written to " +
                               path_.string());
  }

protected:
  int_type overflow(int_type c) override {
    flush();
    return traits_type::eq_int_type(c, traits_type::eof()) ? traits_type::not_eof(c)
                                                           : sputc(traits_type::to_char_type(c));
  }

  int sync() override {
    flush();
    return 0;
  }

  std::streamsize xsputn(const char* from, std::streamsize count) override {
    if (count > epptr() - pptr()) flush();
    if (count > epptr() - pptr()) {
      put({from, static_cast<std::size_t>(count)});
    } else {
      std::memcpy(pptr(), from, static_cast<std::size_t>(count));
      pbump(static_cast<int>(count));
    }
    return count;
  }

private:
  template <class Call> void checked(const Call& call) const {
    try {
      call();
    } catch (const std::system_error& error) {
      cannot_write(path_, error.code());
    }
  }

  void put(std::span<const char> bytes) {
    hash_.add(bytes);
    checked([&] { file_->write(bytes); });
  }

  void flush() {
    put({pbase(), pptr()});
    setp(piece_.data(), piece_.data() + piece_.size());
  }

  fs::path path_;
  std::unique_ptr<os::FileToWrite> file_;
  Hash hash_;
  std::array<char, piece_bytes> piece_;
};

OutputFile::OutputFile(const fs::path& path)
    : std::ostream(nullptr), buffer_(std::make_unique<Buffer>(path)) {
  rdbuf(buffer_.get());
  exceptions(std::ios::badbit | std::ios::failbit); // the buffer's own exceptions come through
}

OutputFile::~OutputFile() = default;

void OutputFile::finish() {
  buffer_->finish();
}

void write_file(const fs::path& path, std::string_view content) {
  OutputFile out(path);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.finish();
}

std::string read_file(const fs::path& path, std::uint64_t most) {
  InputFile in(path, path.string(), most);
  std::string text; // read in large pieces: one character at a time is ten times slower
  std::size_t size = 0;
  do {
    text.resize(std::max<std::size_t>(2 * size, in.size() + 1));
    size += in.read_at(size, {text.data() + size, text.size() - size});
  } while (size == text.size());
  text.resize(size);
  return text;
}

std::uint64_t hash_of_file(const fs::path& path, const std::string& named) {
  InputFile in(path, named);
  return hash_of_file(in);
}

std::uint64_t hash_of_file(InputFile& in) {
  Hash hash;
  std::vector<char> piece(16 * piece_bytes);
  for (std::uint64_t at = 0;;) {
    const std::size_t got = in.read_at(at, piece);
    if (got == 0) return hash.value();
    hash.add({piece.data(), got});
    at += got;
  }
}

bool are_equal(const fs::path& a, const fs::path& b) {
  InputFile first(a, a.string()), second(b, b.string());
  std::vector<char> of_first(16 * piece_bytes), of_second(of_first.size());
  for (std::uint64_t at = 0;; at += of_first.size()) {
    const std::size_t got = first.read_at(at, of_first);
    if (got != second.read_at(at, of_second) ||
        std::memcmp(of_first.data(), of_second.data(), got) != 0)
      return false;
    if (got < of_first.size()) return true;
  }
}

std::string first_bytes(const fs::path& path, std::size_t count) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return "";
  std::string bytes(count, '\0');
  bytes.resize(InputFile(path, path.string()).read_at(0, bytes));
  return bytes;
}

} // namespace frictab::io
