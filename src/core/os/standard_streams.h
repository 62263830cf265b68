// Standard output and standard error, which may be full, closed or read by nobody.
#pragma once

#include <cstdio>
#include <string_view>

namespace frictab::os {

// Opens those of the three standard streams that the program was started without, so that no file
// it opens becomes one of them; writing to them then fails. A write that nobody reads, or beyond
// the limit of a file's size (ulimit -f), fails as well, instead of ending the program.
void keep_standard_streams();

// Writes to stdout or stderr. A failure shows in std::ferror(stream) and nowhere else.
void put(std::FILE* stream, std::string_view text) noexcept;

// True if stdout is a pipe whose reader has gone.
bool nobody_reads_stdout();

} // namespace frictab::os
