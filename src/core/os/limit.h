// Resource limits of this process, set in a child before its work begins.
#pragma once

#include <cstdint>

namespace frictab::os {

// Lowers a limit of setrlimit(2), for example RLIMIT_CORE, to `value`, for good; leaves a lower
// one. Allocates nothing, so that it may run between fork and exec.
void set_limit(int what, std::uint64_t value) noexcept;

} // namespace frictab::os
