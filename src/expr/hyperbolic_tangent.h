// tanh without branches, so that a loop over rows computes several values at a time. A network of
// the ensemble spends most of its time here; the library's tanh handles one value per call.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/wide.h"

namespace frictab::expr {

// Horner's rule for a polynomial, highest power first.
template <class... Lower> FRICTAB_INLINE double horner(double x, double highest, Lower... lower) {
  ((highest = highest * x + lower), ...);
  return highest;
}

// exp(x) - 1 for 0 <= x <= 700, accurate to the last few bits near 0 as well. With x = k ln 2 + r,
// |r| at most (ln 2)/2, exp(x) - 1 = 2^k (exp(r) - 1) + (2^k - 1). exp(r) - 1 is its series to
// r^13, whose next term is below 1e-17 of the sum. ln 2 is split into two parts, so that k times
// the first one is exact (Cody and Waite, Software Manual for the Elementary Functions, 1980).
FRICTAB_INLINE double positive_expm1(double x) {
  constexpr double log2_of_e = 0x1.71547652b82fep0;
  constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;
  constexpr double to_integer = 0x1.8p52; // adding it rounds to whole numbers
  const double shifted = x * log2_of_e + to_integer;
  const double k = shifted - to_integer;
  const double r = (x - k * ln2_high) - k * ln2_low;
  const double series =
      horner(r, 1.0 / 6227020800, 1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880,
             1.0 / 40320, 1.0 / 5040, 1.0 / 720, 1.0 / 120, 1.0 / 24, 1.0 / 6, 1.0 / 2);
  const double of_r = r + r * r * series;
  const std::uint64_t k_bits = std::bit_cast<std::uint64_t>(shifted); // the lowest bits contain k
  const double power_of_2 = std::bit_cast<double>((k_bits + 1023) << 52);
  return power_of_2 * of_r + (power_of_2 - 1);
}

// Accurate to 3 units in the last place for every x (the library: 2.2); odd, 1 from 20 on, NaN for
// NaN.
FRICTAB_INLINE double hyperbolic_tangent(double x) {
  const double size = std::abs(x);
  const double e = positive_expm1(2 * (size > 20 ? 20 : size));
  return std::copysign(e / (e + 2), x);
}

} // namespace frictab::expr
