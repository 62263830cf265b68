// The message when memory runs out.
#include "core/large_work.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include "core/text.h"

namespace frictab {

namespace {

// Peak memory of this process: by now the memory that was in use is free again.
double most_bytes() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

} // namespace

OutOfMemory::OutOfMemory(const std::string& doing, std::size_t rows, std::string hint)
    : text_("out of memory " + doing), hint_(std::move(hint)) {
  const double bytes = most_bytes();
  if (bytes > 0) text_ += fmt::format(": {} were in use", human_bytes(bytes));
  if (bytes > 0 && rows > 0)
    text_ += fmt::format(", {:.0f} bytes a row", bytes / static_cast<double>(rows));
}

} // namespace frictab
