// Seeded random numbers and a low-discrepancy sequence.
#include "core/random.h"

#include <array>
#include <cmath>
#include <numbers>

namespace frictab {

namespace {
std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

constexpr unsigned next_prime(unsigned above) {
  for (unsigned candidate = above + 1;; ++candidate) {
    unsigned divisor = 2;
    while (divisor < candidate && candidate % divisor != 0)
      ++divisor;
    if (divisor == candidate) return candidate;
  }
}

template <std::size_t count> constexpr std::array<unsigned, count> first_primes() {
  std::array<unsigned, count> primes{};
  unsigned last = 1;
  for (unsigned& prime : primes)
    prime = last = next_prime(last);
  return primes;
}
} // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream)
    : state_(mix(seed + 0x9e3779b97f4a7c15ULL) ^ mix(stream * 0xd1342543de82ef95ULL + 1)) {}

std::uint64_t Random::next() {
  return mix(state_ += 0x9e3779b97f4a7c15ULL);
}

double Random::uniform() {
  return static_cast<double>(next() >> 11) * 0x1.0p-53;
}

double Random::uniform(double low, double high) {
  return low + (high - low) * uniform();
}

double Random::normal() {
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  const double angle = 2.0 * std::numbers::pi * uniform();
  spare_ = radius * std::sin(angle);
  has_spare_ = true;
  return radius * std::cos(angle);
}

std::size_t Random::below(std::size_t count) {
  const std::uint64_t limit = UINT64_MAX - UINT64_MAX % count;
  std::uint64_t value = next();
  while (value >= limit)
    value = next();
  return static_cast<std::size_t>(value % count);
}

void halton(std::uint64_t index, std::span<double> out) {
  static constexpr std::array<unsigned, 32> primes = first_primes<32>();
  unsigned prime = 1;
  for (std::size_t d = 0; d < out.size(); ++d) {
    prime = d < primes.size() ? primes[d] : next_prime(prime);
    double fraction = 1.0;
    double value = 0.0;
    for (std::uint64_t i = index + 1; i > 0; i /= prime) {
      fraction /= prime;
      value += fraction * static_cast<double>(i % prime);
    }
    out[d] = value;
  }
}

} // namespace frictab
