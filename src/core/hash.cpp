// Wraps xxHash.
#include "core/hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace frictab {

std::uint64_t hash_of(std::string_view text) {
  return XXH64(text.data(), text.size(), 0);
}

} // namespace frictab
