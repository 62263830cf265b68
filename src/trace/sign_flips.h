// The signs of whole tests, flipped at random: the largest statistic of many directions in every
// flip.
//
// Tests stand in sixes. Of six scores there are 64 signed sums; each is made once, and a flip then
// takes one of them from every six instead of adding up all tests again.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "trace/tile.h"

namespace frictab::trace {

// Scores of directions scaled to a size of 1 over all tests, and each test's share of it; a column
// per test. Directions that are all 0 stand for none.
struct TileScores {
  Tile scores, shares;
};

class SignFlips {
public:
  // units: per test, which of them change sign together. The first pattern flips nothing.
  SignFlips(std::size_t flips, std::span<const std::size_t> units, std::uint64_t seed);

  std::size_t flips() const { return flips_; }
  // The statistic t of screen.h of each direction, and into `maxima`, per flip, the largest |t|
  // where that is more than what stands there. `least_deviation`: of a sum of scores.
  TileValues statistics(const TileScores& tile, float least_deviation,
                        std::span<float> maxima) const;

private:
  std::size_t flips_, sixes_;
  std::vector<std::uint8_t> pattern_; // flips + 1 times sixes: which of them are flipped
};

} // namespace frictab::trace
