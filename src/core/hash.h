// Hashes of texts and files, to check whether two are equal.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace frictab {

// XXH64 (Collet). Gives the same value on every machine; not safe against deliberate collisions.
std::uint64_t hash_of(std::string_view text);

// As 16 hex digits.
std::string hash_text(std::uint64_t hash);

// The same of bytes that come in pieces.
class Hash {
public:
  Hash();
  ~Hash();
  void add(std::span<const char> bytes);
  std::uint64_t value() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace frictab
