// Hashes of texts, to check whether two texts are equal.
#pragma once

#include <cstdint>
#include <string_view>

namespace frictab {

// XXH64 (Collet). Gives the same value on every machine; not safe against deliberate collisions.
std::uint64_t hash_of(std::string_view text);

} // namespace frictab
