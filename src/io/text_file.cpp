// Reads block by block, so that a disk image is refused before it is read completely.
#include "io/text_file.h"

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"

namespace frictab::io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t block_bytes = std::size_t{1} << 20;

std::string bytes_text(std::uint64_t bytes) {
  return human_bytes(static_cast<double>(bytes));
}

// Checks the text read so far.
class Judge {
public:
  Judge(const std::string& named, const TextLimits& limits) : named_(named), limits_(limits) {}

  void size(std::uint64_t bytes) const {
    if (bytes > limits_.bytes)
      throw InputError({named_, 0, 0}, fmt::format("is larger than {}", bytes_text(limits_.bytes)),
                       "give one file per test: data.training takes a folder or a list; or thin "
                       "the rows");
  }

  void block(const std::string& text, std::size_t first) {
    const bool wide = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
    if (!wide && text.find('\0', first) != text.npos)
      throw InputError({named_, 0, 0}, "this is not a text file", "give CSV text or HDF5");
    const std::size_t last = text.find_last_of("\r\n");
    if (last != text.npos) line_start_ = last + 1;
    if (text.size() - line_start_ > limits_.line_bytes)
      throw InputError({named_, 0, 0},
                       fmt::format("a line is longer than {}", bytes_text(limits_.line_bytes)),
                       "a data file has a row of the table per line; is this one?");
  }

private:
  const std::string& named_;
  const TextLimits& limits_;
  std::size_t line_start_ = 0; // start of the last line so far
};

} // namespace

std::ifstream open_text_file(const fs::path& file, const std::string& named) {
  std::error_code error;
  if (fs::is_directory(file, error))
    throw InputError({named, 0, 0}, "is a directory, a file is needed");
  std::ifstream in(file, std::ios::binary);
  if (!in && !fs::exists(file, error)) throw InputError({named, 0, 0}, "no such file");
  if (!in) throw InputError({named, 0, 0}, "cannot be read", "check its permissions");
  return in;
}

std::string first_bytes(const std::filesystem::path& file, std::size_t count) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes(count, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

std::string read_text_file(const fs::path& file, const std::string& named,
                           const TextLimits& limits) {
  std::ifstream in = open_text_file(file, named);
  Judge judge(named, limits);
  std::error_code error;
  std::uint64_t expected = 0;
  if (fs::is_regular_file(file, error)) expected = fs::file_size(file, error);
  // Reads a small file in one block, with one byte more so that its end is detected.
  const std::size_t block =
      expected > 0 && expected < block_bytes ? static_cast<std::size_t>(expected) + 1 : block_bytes;
  std::string text;
  for (std::size_t size = 0; in; size = text.size()) {
    judge.size(size);
    text.resize(size + block);
    in.read(text.data() + size, static_cast<std::streamsize>(block));
    text.resize(size + static_cast<std::size_t>(in.gcount()));
    judge.block(text, size);
    // Reserves memory for the whole file only after its first block looks like text.
    if (size == 0 && expected <= limits.bytes) text.reserve(expected + block);
  }
  judge.size(text.size());
  if (in.bad()) throw InputError({named, 0, 0}, "cannot be read to its end", "copy it again");
  return text;
}

} // namespace frictab::io
