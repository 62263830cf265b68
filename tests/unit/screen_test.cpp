// The screening test by itself: how often noise passes it, whatever its shape, and what it finds.
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/blocks.h"
#include "trace/screen.h"

namespace frictab::screen_test {

using trace::ScreenResult;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Eigen::VectorXf;

constexpr std::size_t blocks_each = 8; // per experiment
constexpr double level = 0.05;

// Causes that are constant within experiments or vary at random, one shape each, acting on mu.
struct Campaign {
  std::vector<std::vector<trace::GridShape>> shapes;
  VectorXd predicted, residual;
  MatrixXd fitted;
  trace::Blocks blocks;
  std::vector<std::size_t> units;
  trace::NoiseModel noise;

  Campaign(std::size_t experiments, std::size_t causes, std::uint64_t seed) {
    Random random(seed, 11);
    const auto rows = static_cast<Index>(experiments * blocks_each);
    predicted = VectorXd::Constant(rows, 100);
    blocks = test::blocks_of(std::vector<std::size_t>(experiments, blocks_each));
    units.resize(experiments);
    std::iota(units.begin(), units.end(), 0);
    fitted = predicted;
    noise.gain = 0.04;
    noise.slow = 0.02;
    noise.length = 0.25;
    noise.white = 0.01;
    noise.scale = 100;
    for (std::size_t c = 0; c < causes; ++c) {
      trace::GridShape shape;
      shape.direction.resize(rows);
      float held = 0;
      for (Index b = 0; b < rows; ++b) {
        if (c % 2 == 1 || b % static_cast<Index>(blocks_each) == 0)
          held = static_cast<float>(random.normal());
        shape.direction(b) = held;
      }
      shapes.push_back({shape});
    }
    draw(random, [](std::size_t) { return 1.0; });
  }

  // Of the noise model; experiment e scatters `times(e)` as much.
  void draw(Random& random, const std::function<double(std::size_t)>& times) {
    residual.resize(predicted.size());
    const double rho = std::exp(-1 / (blocks_each * noise.length));
    for (std::size_t e = 0; e < blocks.experiments(); ++e) {
      const double of_test = noise.gain * random.normal(), by = times(e);
      double slow = noise.slow * random.normal();
      for (std::size_t b = blocks.first[e]; b < blocks.first[e + 1]; ++b) {
        const auto i = static_cast<Index>(b);
        residual(i) = by * predicted(i) * (of_test + slow + noise.white * random.normal());
        slow = rho * slow + noise.slow * std::sqrt(1 - rho * rho) * random.normal();
      }
    }
  }

  ScreenResult run(std::size_t flips = 199) const {
    const trace::Sensitivities sensitivities = {predicted, VectorXd(), VectorXd()};
    const trace::Whitener whitener(noise, predicted, blocks);
    return trace::screen(
        {shapes, sensitivities, whitener, blocks.first, residual, fitted, units, flips, 1});
  }
};

// Of 300 campaigns of 40 experiments and 24 causes without any effect.
int false_alarms(const std::function<double(std::size_t)>& times) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    Campaign campaign(40, 24, seed);
    Random random(seed, 12);
    campaign.draw(random, times);
    if (campaign.run().p_value <= level) ++alarms;
  }
  return alarms;
}

// Binomial, 300 trials at 0.05: 99.9 % lie from 4 to 28.
TEST(Screen, PassesNoiseAsOftenAsAsked) {
  const int alarms = false_alarms([](std::size_t) { return 1.0; });
  EXPECT_GE(alarms, 4);
  EXPECT_LE(alarms, 28);
}

TEST(Screen, PassesNoiseNoMoreOftenWhereSomeExperimentsScatterFiveTimesAsMuch) {
  EXPECT_LE(false_alarms([](std::size_t e) { return e % 10 == 0 ? 5.0 : 1.0; }), 28);
}

TEST(Screen, FindsACauseAmongOthersAndSaysHowLarge) {
  for (const std::size_t cause : {4u, 7u}) { // constant within experiments, and not
    Campaign campaign(40, 24, 5);
    campaign.residual +=
        0.08 * campaign.predicted.cwiseProduct(campaign.shapes[cause][0].direction.cast<double>());
    const ScreenResult found = campaign.run(999);
    EXPECT_EQ(found.directions[found.best].cause, cause);
    EXPECT_EQ(found.p_value, 0.001);
    const trace::Direction& best = found.directions[found.best];
    EXPECT_NEAR(best.statistic / best.size, 0.08, 0.03);
  }
}

// Up and down within the first `experiments` tests, which a factor of the law cannot imitate.
VectorXf wave(const Campaign& campaign, std::size_t experiments) {
  VectorXf direction = VectorXf::Zero(campaign.predicted.size());
  for (std::size_t b = 0; b < campaign.blocks.first[experiments]; ++b)
    direction(static_cast<Index>(b)) = b % 2 ? 1.0f : -1.0f;
  return direction;
}

TEST(Screen, NeverGivesASmallerProbabilityThanSoFewExperimentsCan) {
  Campaign campaign(8, 4, 3);
  campaign.shapes[1][0].direction = wave(campaign, 8);
  campaign.residual +=
      campaign.predicted.cwiseProduct(campaign.shapes[1][0].direction.cast<double>());
  const ScreenResult result = campaign.run(999);
  EXPECT_EQ(result.directions[result.best].cause, 1u);
  EXPECT_GE(result.p_value, 1.0 / 128);
  EXPECT_LE(result.p_value, 3.0 / 128) << "all patterns of signs but few are behind the truth";
}

TEST(Screen, LeavesOutWhatLivesOnFewerThanSevenTests) {
  Campaign campaign(40, 3, 2);
  campaign.shapes[0][0].direction = wave(campaign, 6);
  campaign.shapes[1][0].direction = wave(campaign, 8);
  campaign.residual += // however large it is there
      campaign.predicted.cwiseProduct(campaign.shapes[0][0].direction.cast<double>());
  const ScreenResult result = campaign.run();
  std::vector<std::size_t> kept;
  for (const trace::Direction& direction : result.directions)
    kept.push_back(direction.cause);
  EXPECT_EQ(kept, (std::vector<std::size_t>{1, 2}));
}

TEST(Screen, LeavesOutWhatFittedParametersImitate) {
  Campaign campaign(40, 3, 2);
  campaign.shapes[2][0].direction.setOnes(); // the law's own factor
  const ScreenResult result = campaign.run();
  EXPECT_EQ(result.absorbed, (std::vector<std::size_t>{2}));
}

// Half of the experiments one way, half the other: flips and the truth are measured alike, so that
// an effect that fills the residual does not hide behind the scatter that it makes itself.
TEST(Screen, ScatterThatTheEffectItselfMakesDoesNotCount) {
  Campaign campaign(40, 1, 9);
  auto& direction = campaign.shapes[0][0].direction;
  for (Index b = 0; b < direction.size(); ++b)
    direction(b) = (b / static_cast<Index>(blocks_each)) % 2 ? 1.0f : -1.0f;
  const VectorXd noise = campaign.residual;
  const auto statistic_at = [&](double size) {
    campaign.residual = noise + size * campaign.predicted.cwiseProduct(direction.cast<double>());
    return std::abs(campaign.run().directions[0].statistic);
  };
  // Five times the scatter; sqrt(40) is the most that scores over their own norm reach.
  EXPECT_GT(statistic_at(0.2), 25 + statistic_at(0));
  // No ceiling: in proportion but for the noise, which adds 1 or takes it off.
  EXPECT_NEAR(statistic_at(0.8) / statistic_at(0.08), 10, 2);
}

} // namespace
} // namespace frictab::screen_test
