// Numbers that stay in a file and are read where they are asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

namespace frictab::io {

// `size` doubles from byte `offset` of a file on. Reading is by pread: safe from any thread, and no
// page of the file counts as memory of this process.
class StoredValues {
public:
  // Throws InputError where the file cannot be opened or is shorter; `named` is how messages call
  // it.
  StoredValues(const std::filesystem::path& file, std::string named, std::uint64_t offset,
               std::size_t size);
  ~StoredValues();
  StoredValues(const StoredValues&) = delete;
  StoredValues& operator=(const StoredValues&) = delete;

  std::size_t size() const { return size_; }
  // values.size() numbers from the `first` one on; throws InputError where the disk fails.
  void read(std::size_t first, std::span<double> values) const;
  // The first value that does not lie between these (NaN never does), or size(). Parallel.
  std::size_t first_not_between(double above, double below) const;

private:
  std::string named_;
  std::uint64_t offset_;
  std::size_t size_;
  int file_;
};

// A file of doubles that is written in pieces, in any order and from any thread.
class ValuesFile {
public:
  // Opens or creates it with room for `size` doubles from byte `offset` on; keeps what is there.
  // Throws InputError where the disk has no room.
  ValuesFile(const std::filesystem::path& file, std::uint64_t offset, std::size_t size);
  ~ValuesFile();
  ValuesFile(const ValuesFile&) = delete;
  ValuesFile& operator=(const ValuesFile&) = delete;

  void write(std::size_t first, std::span<const double> values) const;
  void write_bytes(std::uint64_t at, std::span<const char> bytes) const;
  // Cuts or extends the file.
  void resize(std::uint64_t bytes) const;

private:
  std::filesystem::path name_;
  std::uint64_t offset_;
  int file_;
};

// Throws InputError where the disk of `directory` (which may not exist yet) has not `bytes` free;
// `what` needs them: "the table of shaw".
void check_disk_space(const std::filesystem::path& directory, std::uint64_t bytes,
                      const std::string& what, const std::string& hint);

} // namespace frictab::io
