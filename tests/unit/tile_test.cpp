// Directions side by side: the same numbers as one by one.
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/blocks.h"
#include "trace/noise.h"
#include "trace/projection.h"
#include "trace/sign_flips.h"

namespace frictab::tile_test {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using trace::Tile;
using trace::tile_width;

MatrixXd drawn(Index rows, Index columns, std::uint64_t seed) {
  Random random(seed, 1);
  MatrixXd x(rows, columns);
  for (double& value : x.reshaped())
    value = random.normal();
  return x;
}

// Tests of many lengths, one of them of a single block; five directions that no test may see.
TEST(TileWhitener, WhitensThirtyTwoDirectionsAsTheWhitenerDoesOne) {
  const trace::Blocks blocks = test::blocks_of({40, 1, 7, 33, 2, 40});
  const auto count = static_cast<Index>(blocks.count());
  trace::NoiseModel noise;
  noise.gain = 0.04;
  noise.slope = 0.02;
  noise.slow = 0.03;
  noise.length = 0.25;
  noise.white = 0.02;
  noise.scale = 100;
  const VectorXd tau = VectorXd::LinSpaced(count, 60, 140);
  const trace::Whitener whitener(noise, tau, blocks, drawn(count, 5, 2));
  MatrixXd one_by_one = 10 * drawn(count, tile_width, 3);
  Tile tile = one_by_one.transpose().cast<float>();
  whitener.apply(one_by_one);
  trace::TileWhitener(whitener).apply(tile);
  EXPECT_LT((tile.transpose().cast<double>() - one_by_one).cwiseAbs().maxCoeff(),
            2e-6 * one_by_one.cwiseAbs().maxCoeff());
}

TEST(Tile, ProjectsOffAnyNumberOfColumns) {
  for (const Index count : {0, 1, 3, 4, 9}) {
    const MatrixXd q = trace::orthonormal(drawn(131, count, 4));
    const MatrixXd x = drawn(131, tile_width, 5);
    Tile tile = x.transpose().cast<float>();
    const Eigen::MatrixXf columns = q.transpose().cast<float>();
    trace::take_off(columns, trace::along(columns, tile), tile);
    const MatrixXd left = count == 0 ? x : MatrixXd(x - q * (q.transpose() * x));
    EXPECT_LT((tile.transpose().cast<double>() - left).cwiseAbs().maxCoeff(), 5e-6);
  }
}

// The statistic of screen.h, by its definition.
double statistic(const VectorXd& scores, const VectorXd& shares) {
  const auto n = static_cast<double>(scores.size());
  return scores.sum() / std::sqrt(n / (n - 1) * (scores - scores.sum() * shares).squaredNorm());
}

// Thirteen tests, so that the last six are not full, in three units: of eight patterns of signs
// four give another |t|.
TEST(SignFlips, GiveTheLargestStatisticOfEveryPatternOfUnitsAndNoOther) {
  const std::vector<std::size_t> units = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 2};
  const auto tests = static_cast<Index>(units.size());
  const MatrixXd scores = drawn(tests, 5, 6);
  MatrixXd shares = drawn(tests, 5, 7).cwiseAbs2();
  for (auto column : shares.colwise())
    column /= column.sum();
  trace::TileScores tile{Tile::Zero(tile_width, tests), Tile::Zero(tile_width, tests)};
  tile.scores.topRows(5) = scores.transpose().cast<float>();
  tile.shares.topRows(5) = shares.transpose().cast<float>();
  std::vector<float> maxima(200, 0.0f);
  const trace::SignFlips flips(maxima.size(), units, 1);
  const trace::TileValues found = flips.statistics(tile, 0, maxima);
  for (Index d = 0; d < 5; ++d)
    EXPECT_NEAR(found(d), statistic(scores.col(d), shares.col(d)), 1e-5);
  EXPECT_EQ(found.tail(tile_width - 5).abs().maxCoeff(), 0) << "what stands for no direction";
  std::vector<double> possible;
  for (int pattern = 0; pattern < 4; ++pattern) { // the other four are mirror images
    double largest = 0;
    for (Index d = 0; d < 5; ++d) {
      VectorXd flipped = scores.col(d);
      for (Index t = 0; t < tests; ++t)
        if (pattern >> units[static_cast<std::size_t>(t)] & 1) flipped(t) = -flipped(t);
      largest = std::max(largest, std::abs(statistic(flipped, shares.col(d))));
    }
    possible.push_back(largest);
  }
  std::set<std::size_t> seen;
  for (const float largest : maxima) {
    const auto same = [&](double p) { return std::abs(p - static_cast<double>(largest)) < 1e-5; };
    const auto at = std::find_if(possible.begin(), possible.end(), same);
    ASSERT_NE(at, possible.end()) << largest;
    seen.insert(static_cast<std::size_t>(at - possible.begin()));
  }
  EXPECT_EQ(seen.size(), possible.size()) << "of 200 flips each pattern is drawn";
}

} // namespace
} // namespace frictab::tile_test
