// Output that appears complete or not at all.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace frictab::io {

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
  // A complete file that already stands somewhere in the directory, under a working name: commit()
  // renames it to `path`; without commit() it stays where it is.
  void adopt(const std::string& path, std::filesystem::path file);
  // A file of an earlier run that commit() removes unless it was written anew; directories that
  // become empty go with it.
  void remove_old(const std::string& path);
  // Replaces what is there file by file, each by a rename; throws std::runtime_error where the disk
  // refuses.
  void commit();
  // True where a staged file already exists in the directory with other content: what a command
  // that must not overwrite asks before commit().
  bool would_change() const;
  std::vector<std::string> paths() const; // staged so far, sorted

private:
  std::filesystem::path directory_;
  std::filesystem::path staging_;
  std::vector<std::string> paths_;
  std::map<std::string, std::filesystem::path> adopted_; // by path
  std::vector<std::string> old_;
  bool created_ = false; // the directory is ours to remove again
};

// The whole file; throws InputError where it cannot be read.
std::string read_file(const std::filesystem::path& file);

} // namespace frictab::io
