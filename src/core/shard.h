// Splits work among processes that do not communicate: --shard i/n.
#pragma once

#include <cstdint>
#include <string>

namespace frictab {

// Every n-th piece, counted from 1. Each piece belongs to exactly one shard.
struct Shard {
  std::uint64_t number = 1, of = 1;
  bool has(std::uint64_t piece) const { return piece % of == number - 1; }
  std::string text() const { return std::to_string(number) + "/" + std::to_string(of); }
};

// Parses "3/8". Throws InputError.
Shard read_shard(const std::string& text);

} // namespace frictab
