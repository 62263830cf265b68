// Reads block by block, so that a disk image is refused before it is read completely.
#include "io/text_file.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "io/file_streams.h"

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

std::string read_text_file(const fs::path& file, const std::string& named,
                           const TextLimits& limits) {
  InputFile in(file, named);
  Judge judge(named, limits);
  // Reads a small file in one block, with one byte more so that its end is detected.
  const std::size_t block = std::min<std::uint64_t>(in.size() + 1, block_bytes);
  std::string text;
  std::size_t size = 0;
  do {
    judge.size(size);
    text.resize(size + block);
    const std::size_t got = in.read_at(size, {text.data() + size, block});
    text.resize(size + got);
    judge.block(text, size);
    // Reserves memory for the whole file only after its first block looks like text.
    if (size == 0 && in.size() <= limits.bytes) text.reserve(in.size() + block);
    size = got < block ? 0 : text.size();
  } while (size > 0);
  judge.size(text.size());
  return text;
}

} // namespace frictab::io
