// A part of work that several processes share without talking to each other: --shard i/n.
#pragma once

#include <cstdint>
#include <string>

namespace frictab {

// Every n-th piece, from 1. Each piece is in one shard.
struct Shard {
  std::uint64_t number = 1, of = 1;
  bool has(std::uint64_t piece) const { return piece % of == number - 1; }
  std::string text() const { return std::to_string(number) + "/" + std::to_string(of); }
};

// "3/8". Throws InputError.
Shard read_shard(const std::string& text);

} // namespace frictab
