// Signed sums of six tests, and sums of those.
#include "trace/sign_flips.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"

namespace frictab::trace {

namespace {

using Eigen::Index;

constexpr std::uint64_t flip_stream = 71;
constexpr float least_variance_share = 1e-3f; // of the sum of squared scores, as a variance
constexpr std::size_t six = 6, sums_of_six = 1 << six;
constexpr Index pair_width = 2 * tile_width; // a score, and it times the share

// The 64 signed sums of six pairs (or the last few), number b being that of pattern b.
FRICTAB_WIDE void sum_six(const float* pairs, std::size_t count, float* sums) {
  std::fill_n(sums, pair_width, 0.0f);
  for (std::size_t i = 0; i < count; ++i) {
    const float* x = pairs + i * pair_width;
    for (std::size_t b = 0; b < std::size_t{1} << i; ++b) {
      float* plus = sums + b * pair_width;
      float* minus = plus + (std::size_t{1} << i) * pair_width;
      for (Index l = 0; l < pair_width; ++l)
        minus[l] = plus[l] - x[l];
      for (Index l = 0; l < pair_width; ++l)
        plus[l] += x[l];
    }
  }
}

// Of each direction: sum of squares of scores and of shares, and the least variance.
struct Squares {
  float scores[tile_width], shares[tile_width], least[tile_width];
};

// Sum of scores, and its variance over tests once it is taken off by shares.
FRICTAB_INLINE void sum_pattern(const std::uint8_t* pattern, std::size_t sixes, const float* sums,
                                const Squares& of, float* sum, float* variance) {
  Lanes s[lane_parts] = {}, with[lane_parts] = {}, x[lane_parts];
  for (std::size_t i = 0; i < sixes; ++i) {
    const float* pair = sums + (i * sums_of_six + pattern[i]) * pair_width;
    load_lanes(pair, x);
    for (Index p = 0; p < lane_parts; ++p)
      s[p] += x[p];
    load_lanes(pair + tile_width, x);
    for (Index p = 0; p < lane_parts; ++p)
      with[p] += x[p];
  }
  Lanes scores[lane_parts], shares[lane_parts], least[lane_parts];
  load_lanes(of.scores, scores);
  load_lanes(of.shares, shares);
  load_lanes(of.least, least);
  for (Index p = 0; p < lane_parts; ++p) {
    const Lanes v = scores[p] - 2.0f * s[p] * with[p] + s[p] * s[p] * shares[p];
    x[p] = v > least[p] ? v : least[p];
  }
  store_lanes(s, sum);
  store_lanes(x, variance);
}

// Squares of statistics: of each direction for one pattern, ...
FRICTAB_WIDE void squares_of_pattern(const std::uint8_t* pattern, std::size_t sixes,
                                     const float* sums, const Squares& of, float* sum,
                                     float* square) {
  float variance[tile_width];
  sum_pattern(pattern, sixes, sums, of, sum, variance);
  for (Index l = 0; l < tile_width; ++l)
    square[l] = sum[l] * sum[l] / variance[l];
}

// ... and the largest for many.
FRICTAB_WIDE void largest_squares(const std::uint8_t* patterns, std::size_t count,
                                  std::size_t sixes, const float* sums, const Squares& of,
                                  float* largest) {
  float sum[tile_width], variance[tile_width], square[tile_width];
  for (std::size_t f = 0; f < count; ++f) {
    sum_pattern(patterns + f * sixes, sixes, sums, of, sum, variance);
    for (Index l = 0; l < tile_width; ++l)
      square[l] = sum[l] * sum[l] / variance[l];
    for (Index half = tile_width / 2; half > 0; half /= 2)
      for (Index l = 0; l < half; ++l)
        square[l] = square[l] > square[l + half] ? square[l] : square[l + half];
    largest[f] = square[0];
  }
}

} // namespace

SignFlips::SignFlips(std::size_t flips, std::span<const std::size_t> units, std::uint64_t seed)
    : flips_(flips), sixes_((units.size() + six - 1) / six),
      pattern_((flips + 1) * sixes_, std::uint8_t{0}) {
  std::vector<bool> flipped(*std::max_element(units.begin(), units.end()) + 1);
  for (std::size_t f = 0; f < flips; ++f) {
    Random random(seed, flip_stream + 1000 * static_cast<std::uint64_t>(f));
    for (std::size_t u = 0; u < flipped.size(); ++u)
      flipped[u] = random.uniform() < 0.5;
    for (std::size_t t = 0; t < units.size(); ++t)
      if (flipped[units[t]])
        pattern_[(f + 1) * sixes_ + t / six] |= static_cast<std::uint8_t>(1 << t % six);
  }
}

// sum (U - b I)^2 = sum U^2 - 2 b sum U I + b^2 sum I^2, b being the sum of scores, since sizes I
// are shares of 1.
TileValues SignFlips::statistics(const TileScores& tile, float least_deviation,
                                 std::span<float> maxima) const {
  const Index tests = tile.scores.cols();
  const auto count = static_cast<float>(tests);
  const float wider = count / std::max(count - 1, 1.0f);
  Eigen::Matrix<float, pair_width, Eigen::Dynamic> pairs(pair_width, tests);
  pairs.topRows(tile_width) = tile.scores;
  pairs.bottomRows(tile_width) = tile.scores.cwiseProduct(tile.shares);
  std::vector<float> sums(sixes_ * sums_of_six * pair_width);
  for (std::size_t i = 0; i < sixes_; ++i)
    sum_six(pairs.data() + i * six * pair_width,
            std::min(six, static_cast<std::size_t>(tests) - i * six),
            sums.data() + i * sums_of_six * pair_width);
  Squares of;
  const TileValues total = tile.scores.rowwise().squaredNorm();
  const TileValues least =
      (least_variance_share * total).max(least_deviation * least_deviation / wider);
  Eigen::Map<TileValues>(of.scores) = total;
  Eigen::Map<TileValues>(of.shares) = tile.shares.rowwise().squaredNorm();
  Eigen::Map<TileValues>(of.least) = (total > 0).select(least, TileValues::Ones());
  TileValues sum, square;
  squares_of_pattern(pattern_.data(), sixes_, sums.data(), of, sum.data(), square.data());
  std::vector<float> largest(flips_);
  largest_squares(pattern_.data() + sixes_, flips_, sixes_, sums.data(), of, largest.data());
  for (std::size_t f = 0; f < flips_; ++f)
    maxima[f] = std::max(maxima[f], std::sqrt(largest[f] / wider));
  return (sum < 0).select(-1.0f, TileValues::Ones()) * (square / wider).sqrt();
}

} // namespace frictab::trace
