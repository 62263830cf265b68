// Which chunks of a work file are finished, on disk, so that a killed run can go on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace frictab::table {

// Per finished chunk the hash of its bytes.
using Chunks = std::map<std::size_t, std::uint64_t>;

// One line per finished chunk: its number and the hash of its bytes, below one line that says what
// the chunks belong to.
class ChunkList {
public:
  // Opens or creates it. A list of another job (another first line) is emptied; a last line that
  // was cut by a kill is dropped. Throws InputError where another process has it open (file systems
  // without locks do not tell).
  ChunkList(const std::filesystem::path& file, const std::string& job);
  ~ChunkList();
  ChunkList(const ChunkList&) = delete;
  ChunkList& operator=(const ChunkList&) = delete;

  const Chunks& found() const { return found_; }
  void add(std::size_t chunk, std::uint64_t hash) const; // from any thread

private:
  std::filesystem::path name_;
  int file_;
  Chunks found_;
};

// Whether another process has this list open for a job other than `job`.
bool in_use_for_another_job(const std::filesystem::path& file, const std::string& job);

} // namespace frictab::table
