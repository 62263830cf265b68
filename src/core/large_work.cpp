// The message when memory runs out.
#include "core/large_work.h"

#include <fmt/format.h>

#include "core/os/machine.h"
#include "core/text.h"

namespace frictab {

OutOfMemory::OutOfMemory(const std::string& doing, std::size_t rows, std::string hint)
    : text_("out of memory " + doing), hint_(std::move(hint)) {
  const double bytes = os::peak_memory(); // by now what was in use is free again
  if (bytes > 0) text_ += fmt::format(": {} were in use", human_bytes(bytes));
  if (bytes > 0 && rows > 0)
    text_ += fmt::format(", {:.0f} bytes a row", bytes / static_cast<double>(rows));
}

} // namespace frictab
