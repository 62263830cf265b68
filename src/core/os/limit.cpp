// Sets both the soft and the hard limit, so that the child cannot raise it again.
#include "core/os/limit.h"

#include <algorithm>

#include <sys/resource.h>

namespace frictab::os {

void set_limit(int what, std::uint64_t value) noexcept {
  rlimit old{};
  if (::getrlimit(static_cast<__rlimit_resource>(what), &old) != 0) return;
  const rlim_t most = std::min<rlim_t>(value, old.rlim_max); // RLIM_INFINITY is the largest
  const rlimit limit{most, most};
  ::setrlimit(static_cast<__rlimit_resource>(what), &limit);
}

} // namespace frictab::os
