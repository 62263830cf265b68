// Fits to blocks under a noise model.
#include <gtest/gtest.h>

#include "effects/extended_law.h"
#include "support/blocks.h"
#include "trace/search/law_on_blocks.h"

namespace frictab::law_on_blocks_test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

const stats::Blocks blocks = test::blocks_of({20, 20, 20, 20});

// Along each experiment.
VectorXd between(double first, double last) {
  return ((blocks.position.array() + 0.5) * (last - first) + first).matrix();
}

// tau_R = mu (1 + a (s - 0)/5) sigma_n
models::Law falling_along_the_way() {
  effects::PlacedEffect effect;
  effect.form = effects::find_effect("linear");
  effect.acts_on = effects::ActsOn::mu;
  effect.inputs = {{"s_mm", {}, 0, 5}};
  effect.parameters = {0, 0, 5};
  const double mu[] = {0.1};
  return effects::extended_law(*models::find_law("coulomb"), {}, mu, {&effect, 1}, "falling");
}

class FitOfBlocks : public testing::Test {
protected:
  // Tests lie up to half too high or too low as a whole; within them noise is small.
  VectorXd fitted(double slope) {
    const VectorXd s = between(0, 5), sigma = between(100, 400);
    trace::BlockColumns columns;
    for (const std::string& input : models::inputs(falling_along_the_way(), {}))
      columns[input] = input == "s_mm" ? s : sigma;
    const trace::LawOnBlocks law(falling_along_the_way(), {}, columns);
    measured_ = 0.1 * sigma.array() * (1 + slope * s.array() / 5);
    const std::vector<double> start = {0.1, 0.0};
    const VectorXd tau = law.predict(start);
    stats::NoiseModel noise;
    noise.gain = 0.5;
    noise.slow = 0;
    noise.white = 0.01;
    noise.scale = tau.mean();
    return trace::fit_blocks(law, measured_, stats::Whitener(noise, tau, blocks), start).predicted;
  }

  VectorXd measured_;
};

TEST_F(FitOfBlocks, FindsAnEffectThatLeavesFriction) {
  const VectorXd tau = fitted(-0.9);
  EXPECT_LT((tau - measured_).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(FitOfBlocks, NeverTakesABlocksFrictionAwayAltogether) {
  const VectorXd tau = fitted(-3); // of "measured" values that no friction can have
  EXPECT_GT(tau.minCoeff(), 0);
}

} // namespace
} // namespace frictab::law_on_blocks_test
