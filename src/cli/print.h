// Text to stdout and stderr. What cannot be written is found out at the end of the program, so that
// every command ends with its own exit code.
#pragma once

#include <utility>

#include <fmt/format.h>

#include "core/os/standard_streams.h"

namespace frictab::cli {

template <class... Values>
void print_out(fmt::format_string<Values...> format, Values&&... values) {
  os::put(stdout, fmt::format(format, std::forward<Values>(values)...));
}

template <class... Values>
void print_error(fmt::format_string<Values...> format, Values&&... values) {
  os::put(stderr, fmt::format(format, std::forward<Values>(values)...));
}

} // namespace frictab::cli
