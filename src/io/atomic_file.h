// Output that appears complete or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace frictab {

// Files of one command, written beside the target directory and moved into place by commit();
// without commit() nothing changes. Paths are relative to the directory.
class OutputFiles {
public:
  explicit OutputFiles(std::filesystem::path directory);
  ~OutputFiles(); // removes what was not committed
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;

  void write(const std::string& path, std::string_view content);
  // A place to write one file by other means (HDF5); committed like the others.
  std::filesystem::path stage(const std::string& path);
  // Throws InputError (exit 2) where a file exists and `force` is not set and it was not written by
  // frictab before (see commit), std::runtime_error where the disk refuses.
  void commit();
  std::vector<std::string> paths() const; // staged so far, sorted

private:
  std::filesystem::path directory_;
  std::filesystem::path staging_;
  std::vector<std::string> paths_;
};

// The whole file; throws InputError where it cannot be read.
std::string read_file(const std::filesystem::path& file);

} // namespace frictab
