// Text of a data file, read only as long as it looks like text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace frictab::io {

// Size limits of a data file, far above what rigs write in a test.
struct TextLimits {
  std::uint64_t bytes = std::uint64_t{8} << 30;
  std::uint64_t line_bytes = std::uint64_t{64} << 20;
};

// Throws InputError, with the file's name in messages (`named`), if the file cannot be read,
// contains a 0 byte (UTF-16 with a BOM may), or exceeds the limits; it stops at the block that
// shows the fault.
std::string read_text_file(const std::filesystem::path& file, const std::string& named,
                           const TextLimits& limits = {});

} // namespace frictab::io
