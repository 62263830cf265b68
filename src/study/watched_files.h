// Files that are read for a campaign, compared with what its key was made from.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/os/open_file.h"

namespace frictab::study {

class WatchedFiles {
public:
  // Returns the hash of its bytes. Throws InputError, with the file's name in messages (`named`),
  // if it cannot be read.
  std::uint64_t add(const std::filesystem::path& path, const std::string& named);

  // Throws std::runtime_error, with the names, if files have other bytes than when they were added.
  void check_bytes();
  // Throws it if files were written since add() or check_bytes(), even if they now have equal
  // bytes.
  void check_untouched() const;

private:
  struct Watched {
    std::filesystem::path path;
    std::string named;
    std::uint64_t hash = 0;
    os::FileState state;
    bool is_untouched() const;
  };
  std::vector<Watched> all_;
};

} // namespace frictab::study
