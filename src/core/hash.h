// Texts as numbers, to tell whether they are the same.
#pragma once

#include <cstdint>
#include <string_view>

namespace frictab {

// XXH64 (Collet): the same on every machine; no defence against who wants two texts to agree.
std::uint64_t hash_of(std::string_view text);

} // namespace frictab
