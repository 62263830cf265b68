// Wraps xxHash.
#include "core/hash.h"

#define XXH_INLINE_ALL
#include <fmt/format.h>
#include <xxhash.h>

namespace frictab {

std::uint64_t hash_of(std::string_view text) {
  return XXH64(text.data(), text.size(), 0);
}

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}

struct Hash::State {
  XXH64_state_t of_library;
};

Hash::Hash() : state_(std::make_unique<State>()) {
  XXH64_reset(&state_->of_library, 0);
}

Hash::~Hash() = default;

void Hash::add(std::span<const char> bytes) {
  XXH64_update(&state_->of_library, bytes.data(), bytes.size());
}

std::uint64_t Hash::value() const {
  return XXH64_digest(&state_->of_library);
}

} // namespace frictab
