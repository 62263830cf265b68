// A file for readers that take a name; gone with the process.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace frictab::fuzz {

class TemporaryFile {
public:
  explicit TemporaryFile(const std::string& name) {
    std::string place = std::filesystem::temp_directory_path() / "frictab-fuzz-XXXXXX";
    if (::mkdtemp(place.data())) directory_ = place;
    file_ = directory_ / name;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    if (!directory_.empty()) std::filesystem::remove_all(directory_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  void write(std::string_view bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  const std::filesystem::path& path() const { return file_; }
  const std::filesystem::path& directory() const { return directory_; }

private:
  std::filesystem::path directory_, file_;
};

} // namespace frictab::fuzz
