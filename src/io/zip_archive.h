// Files in a ZIP archive, unfolded only within limits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace frictab::io {

// Limits checked by the archive's directory before anything is unfolded: numbers written as XML
// shrink to about a tenth, a trap to a thousandth.
struct ZipLimits {
  std::uint64_t bytes = std::uint64_t{512} << 20; // of one file in it
  std::uint64_t ratio = 200;
  std::uint64_t bytes_of_any_ratio = std::uint64_t{8} << 20;
  std::uint64_t all_bytes = std::uint64_t{8} << 30;  // of all files in it
  std::uint64_t file_bytes = std::uint64_t{2} << 30; // of the archive itself
};

class ZipArchive {
public:
  // Throws InputError, with the file's name in messages (`named`), if it is not an archive or its
  // files are larger than the limit together.
  ZipArchive(const std::filesystem::path& path, const std::string& named, ZipLimits limits = {});
  ~ZipArchive();
  ZipArchive(const ZipArchive&) = delete;
  ZipArchive& operator=(const ZipArchive&) = delete;

  // The contents of one file; nullopt if there is none of this name. Throws InputError if it is
  // damaged, encrypted or beyond the limits.
  std::optional<std::string> read(const std::string& name) const;

private:
  struct Data;
  std::unique_ptr<Data> data_;
};

} // namespace frictab::io
