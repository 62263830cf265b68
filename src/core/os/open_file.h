// Files by their descriptors: every call that fails says so, and no name makes the program wait.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace frictab::os {

// Distinguishes one state of a file from a later one without reading it.
struct FileState {
  std::uint64_t device = 0, inode = 0, bytes = 0;
  std::int64_t modified_ns = 0, changed_ns = 0; // the second cannot be set by a program
  bool operator==(const FileState&) const = default;
};

// A file opened to be read. Opening a pipe or a device does not wait and reads nothing.
class FileToRead {
public:
  enum class Kind { file, directory, pipe_or_device };

  explicit FileToRead(const std::filesystem::path& path); // throws std::system_error
  ~FileToRead();
  FileToRead(const FileToRead&) = delete;
  FileToRead& operator=(const FileToRead&) = delete;

  Kind kind() const { return kind_; }
  const FileState& state() const { return state_; } // when it was opened
  // Reads from byte `at` on; fewer bytes than asked for only at the end. Throws std::system_error.
  std::size_t read(std::uint64_t at, std::span<char> bytes) const;

private:
  int file_;
  Kind kind_ = Kind::file;
  FileState state_;
};

// A file made or emptied to be written. Functions throw std::system_error.
class FileToWrite {
public:
  explicit FileToWrite(const std::filesystem::path& path);
  ~FileToWrite();
  FileToWrite(const FileToWrite&) = delete;
  FileToWrite& operator=(const FileToWrite&) = delete;

  void write(std::span<const char> bytes);
  void close();

private:
  int file_;
};

} // namespace frictab::os
