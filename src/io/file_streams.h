// Streams over files, the only way in which this program reads and writes any. A call that fails is
// never taken for the end of a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <limits>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "core/os/open_file.h"

namespace frictab::io {

// A file to read. Functions throw std::runtime_error if the disk fails.
class InputFile : public std::istream {
public:
  static constexpr std::uint64_t any_size = std::numeric_limits<std::uint64_t>::max();

  // `named`: the file's name in messages. Throws InputError if there is no such file, if it cannot
  // be opened, is a directory, a pipe or a device, or has more than `most` bytes; one that grows
  // beyond them is refused where it is read.
  InputFile(const std::filesystem::path& path, const std::string& named,
            std::uint64_t most = any_size);
  ~InputFile() override;

  std::uint64_t size() const; // when it was opened
  const os::FileState& state() const;
  // Fills `bytes` from offset `at` on, fewer at the end of the file. Returns how many.
  std::size_t read_at(std::uint64_t at, std::span<char> bytes);

private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
};

// A file to write. Every function that writes throws std::runtime_error where that fails.
class OutputFile : public std::ostream {
public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile() override;

  // Closes the file, reads it and compares. Throws if that gives something else than was written.
  void finish();

private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
};

// Writes a whole file and compares, as OutputFile does.
void write_file(const std::filesystem::path& path, std::string_view content);

// Above every job, study, model and result that is read as one text.
inline constexpr std::uint64_t largest_text = std::uint64_t{1} << 30;

// These read a file; they throw as InputFile does.
std::string read_file(const std::filesystem::path& path, std::uint64_t most = largest_text);
std::uint64_t hash_of_file(const std::filesystem::path& path, const std::string& named);
std::uint64_t hash_of_file(InputFile& file);
bool are_equal(const std::filesystem::path& a, const std::filesystem::path& b);
// The first bytes, the signature of its format. Fewer if it is shorter, none if it is not a file.
std::string first_bytes(const std::filesystem::path& path, std::size_t count);

} // namespace frictab::io
