// The text of a data file, read no further than it looks like text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace frictab::io {

// What a data file may be at most; far beyond what rigs write in a test.
struct TextLimits {
  std::uint64_t bytes = std::uint64_t{8} << 30;
  std::uint64_t line_bytes = std::uint64_t{64} << 20;
};

// Throws InputError where it cannot be opened.
std::ifstream open_text_file(const std::filesystem::path& file, const std::string& named);

// Throws InputError, with the name that messages give it, where the file cannot be read, holds a 0
// byte (UTF-16 with a BOM may), or is longer than the limits: at the block in which that shows.
std::string read_text_file(const std::filesystem::path& file, const std::string& named,
                           const TextLimits& limits = {});

} // namespace frictab::io
