// Seeded random numbers, equal on every platform and for any number of threads: each stream is
// identified by a key, so nothing depends on the order of calls elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace frictab {

// SplitMix64 counter generator (Steele, Lea, Flood 2014). Two streams with different keys are
// independent for all practical purposes.
class Random {
public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0);
  std::uint64_t next();
  double uniform();                        // [0, 1), 53 bits
  double uniform(double low, double high); // [low, high)
  double normal();                         // standard normal, Box-Muller (deterministic libm calls)
  std::size_t below(std::size_t count);    // 0 .. count-1, without modulo bias
  template <class T> void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i)
      std::swap(items[i - 1], items[below(i)]);
  }

private:
  std::uint64_t state_;
  double spare_ = 0;
  bool has_spare_ = false;
};

// Point `index` of the Halton sequence in (0,1)^dims, dims = out.size(): coordinate d is the
// radical inverse of index + 1 in the d-th prime (Halton 1960). Covers the box evenly.
void halton(std::uint64_t index, std::span<double> out);

} // namespace frictab
