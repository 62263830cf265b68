// The noise model of the trace stage: weights are V^-1/2, and its parameters are found again.
#include <cmath>
#include <numeric>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "core/random.h"
#include "stats/noise.h"
#include "stats/noise_fit.h"
#include "stats/reml.h"
#include "support/blocks.h"
#include "trace/search/order_search.h"

namespace frictab::trace_noise_test {

using stats::fit_noise;
using stats::NoiseModel;
using trace::test_order;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A block per row; blocks of two and of three rows; one block; blocks of one row and of two.
const stats::Blocks blocks = test::blocks_of({7, 97, 1, 13, 61});

VectorXd some_tau(Index count) {
  VectorXd tau(count);
  for (Index i = 0; i < tau.size(); ++i)
    tau(i) = 60 + 7.0 * static_cast<double>((i * 13) % 11);
  return tau;
}

NoiseModel some_noise(double growth) {
  NoiseModel noise;
  noise.gain = 0.06;
  noise.slope = 0.1;
  noise.slow = 0.04;
  noise.length = 0.1;
  noise.white = 0.02;
  noise.growth = growth;
  noise.scale = 95;
  return noise;
}

// V of one experiment, written out; its blocks count as equally far apart.
MatrixXd dense(const NoiseModel& n, const VectorXd& tau, const stats::Blocks& of,
               std::size_t experiment) {
  const std::size_t begin = of.first[experiment];
  const auto size = static_cast<Index>(of.first[experiment + 1] - begin);
  MatrixXd v(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j) {
      const auto a = static_cast<Index>(begin) + i, b = static_cast<Index>(begin) + j;
      const double apart = static_cast<double>(std::abs(i - j)) / static_cast<double>(size);
      const double rows = static_cast<double>(of.rows(begin + static_cast<std::size_t>(i)));
      const double within = n.slow * n.slow * std::exp(-apart / n.length) +
                            (i == j ? n.white * n.white * of.usual_rows / rows : 0.0);
      const double d = n.scale * n.scale * std::pow(tau(a) / n.scale, n.growth) *
                       std::pow(tau(b) / n.scale, n.growth);
      v(i, j) = tau(a) * tau(b) *
                    (n.gain * n.gain + n.slope * n.slope * of.position(a) * of.position(b)) +
                d * within;
    }
  return v;
}

TEST(Whitener, GivesTheInverseCovarianceOfEveryExperiment) {
  for (const double growth : {0.0, 1.0}) {
    const VectorXd tau = some_tau(static_cast<Index>(blocks.count()));
    const NoiseModel noise = some_noise(growth);
    const stats::Whitener whitener(noise, tau, blocks);
    MatrixXd x(tau.size(), 3);
    for (Index i = 0; i < x.size(); ++i)
      x(i) = std::sin(1.7 * static_cast<double>(i));
    MatrixXd white = x;
    whitener.apply(white);
    for (std::size_t e = 0; e < blocks.experiments(); ++e) {
      const auto begin = static_cast<Index>(blocks.first[e]);
      const auto count = static_cast<Index>(blocks.first[e + 1]) - begin;
      const MatrixXd v = dense(noise, tau, blocks, e);
      const Eigen::LLT<MatrixXd> cholesky(v);
      const MatrixXd part = x.middleRows(begin, count), own = white.middleRows(begin, count);
      EXPECT_LT((own.transpose() * own - part.transpose() * cholesky.solve(part)).norm(), 1e-10);
      EXPECT_NEAR(whitener.log_det()(static_cast<Index>(e)),
                  2 * MatrixXd(cholesky.matrixL()).diagonal().array().log().sum(), 1e-10);
      for (Index i = 0; i < count; ++i)
        EXPECT_NEAR(whitener.variance()(begin + i), v(i, i), 1e-10);
    }
  }
}

TEST(Whitener, SeesNothingAlongNuisanceColumns) {
  const auto count = static_cast<Index>(blocks.count());
  const MatrixXd nuisance = MatrixXd::Random(count, 2);
  const stats::Whitener whitener(some_noise(0), some_tau(count), blocks, nuisance);
  MatrixXd x = nuisance * MatrixXd::Random(2, 3);
  whitener.apply(x);
  EXPECT_LT(x.norm(), 1e-9);
}

// Residuals drawn from the model; experiments of 25 blocks.
struct Drawn {
  stats::Blocks blocks;
  VectorXd residual, tau;
  MatrixXd fitted, nuisance;

  stats::NoiseData data() const { return {residual, tau, blocks, fitted, nuisance}; }
};

Drawn draw(const NoiseModel& noise, std::size_t count, std::uint64_t seed) {
  constexpr Index size = 25;
  Drawn drawn;
  drawn.blocks = test::blocks_of(std::vector<std::size_t>(count, static_cast<std::size_t>(size)));
  drawn.residual.resize(static_cast<Index>(count) * size);
  drawn.tau.resize(drawn.residual.size());
  Random random(seed);
  for (Index i = 0; i < drawn.tau.size(); ++i)
    drawn.tau(i) = noise.scale * (0.6 + 0.8 * random.uniform());
  for (std::size_t e = 0; e < count; ++e) {
    VectorXd z(size);
    for (Index i = 0; i < size; ++i)
      z(i) = random.normal();
    const Eigen::LLT<MatrixXd> cholesky(dense(noise, drawn.tau, drawn.blocks, e));
    drawn.residual.segment(static_cast<Index>(e) * size, size) = cholesky.matrixL() * z;
  }
  return drawn;
}

void expect_alike(const NoiseModel& a, const NoiseModel& b, double relative) {
  EXPECT_EQ(a.growth, b.growth);
  EXPECT_EQ(a.length, b.length);
  EXPECT_NEAR(a.gain / b.gain, 1, relative);
  EXPECT_NEAR(a.slope / b.slope, 1, relative);
  EXPECT_NEAR(a.slow / b.slow, 1, relative);
  EXPECT_NEAR(a.white / b.white, 1, relative);
}

// The restricted likelihood as its definition says, but for what all noise of one growth shares.
double written_out(const NoiseModel& noise, const Drawn& drawn) {
  const std::vector<Index> first(drawn.blocks.first.begin(), drawn.blocks.first.end());
  return -stats::DenseReml(
              {drawn.fitted, drawn.residual, first},
              [&](std::size_t e) { return dense(noise, drawn.tau, drawn.blocks, e); },
              VectorXd::Zero(drawn.fitted.cols()))
              .criterion();
}

// Experiments that share their blocks with others, and ones that share them with none.
TEST(NoiseModel, LikelihoodIsThatOfTheWholeCovariance) {
  Drawn drawn;
  drawn.blocks = test::blocks_of({7, 97, 1, 13, 61, 13, 97, 13, 1});
  const auto count = static_cast<Index>(drawn.blocks.count());
  drawn.tau = some_tau(count);
  drawn.residual.resize(count);
  drawn.fitted.resize(count, 2);
  Random random(4);
  for (Index i = 0; i < count; ++i) {
    drawn.residual(i) = 5 * random.normal() + (i == 0 ? 0 : 0.7 * drawn.residual(i - 1));
    drawn.fitted.row(i) << drawn.tau(i), random.normal();
  }
  for (const double growth : {0.0, 1.0}) {
    NoiseModel earlier = some_noise(growth);
    const stats::NoiseFit one = stats::refine_noise(drawn.data(), earlier);
    earlier.length = 0.4;
    const stats::NoiseFit other = stats::refine_noise(drawn.data(), earlier);
    const double expected = written_out(one.noise, drawn) - written_out(other.noise, drawn);
    EXPECT_GT(std::abs(expected), 1);
    // To what the data leave open the fit adds 1e-6 of the square of each logarithm, 8 at most.
    EXPECT_NEAR(one.log_likelihood - other.log_likelihood, expected, 4 * 64e-6);
  }
}

TEST(NoiseModel, IsFoundAgainFromItsOwnResiduals) {
  for (const double growth : {0.0, 1.0}) {
    const NoiseModel truth = some_noise(growth);
    const NoiseModel found = fit_noise(draw(truth, 200, 5).data()).noise;
    EXPECT_EQ(found.growth, growth);
    EXPECT_EQ(found.length, truth.length);
    EXPECT_NEAR(found.scale, 95, 1); // of what was drawn
    // Three standard errors: 5 % between 200 experiments, where the slow noise blurs it a little;
    // 2 % within 5,000 blocks.
    EXPECT_NEAR(found.gain, truth.gain, 0.18 * truth.gain);
    EXPECT_NEAR(found.slope, truth.slope, 0.18 * truth.slope);
    EXPECT_NEAR(found.slow, truth.slow, 0.08 * truth.slow);
    EXPECT_NEAR(found.white, truth.white, 0.08 * truth.white);
  }
}

TEST(NoiseModel, ASlopeOfItsOwnInEachTestIsNotTakenForSlowNoiseOrGain) {
  NoiseModel flat = some_noise(1), sloping = flat;
  flat.slope = 0;
  sloping.slope = 0.3;
  const NoiseModel without = fit_noise(draw(flat, 80, 3).data()).noise;
  const NoiseModel with = fit_noise(draw(sloping, 80, 3).data()).noise;
  // The same draws otherwise; what is left is that a slope hides some slow noise.
  EXPECT_NEAR(with.gain / without.gain, 1, 0.1);
  EXPECT_NEAR(with.slow / without.slow, 1, 0.1);
  EXPECT_EQ(with.length, without.length);
  EXPECT_NEAR(with.slope, 0.3, 3 * 0.3 / std::sqrt(2 * 80.0));
  EXPECT_LT(without.slope, 0.1) << "three slow values each: they alone make slopes like that";
}

TEST(NoiseModel, IsTheSameInAnyUnitOfStress) {
  const Drawn drawn = draw(some_noise(1), 30, 7);
  const NoiseModel plain = fit_noise(drawn.data()).noise;
  for (const double unit : {1e-6, 1e6}) {
    Drawn other = drawn;
    other.residual *= unit;
    other.tau *= unit;
    const NoiseModel found = fit_noise(other.data()).noise;
    expect_alike(found, plain, 1e-6);
    EXPECT_NEAR(found.scale / (unit * plain.scale), 1, 1e-12);
  }
}

TEST(NoiseModel, DigitsThatNobodyRecordedDoNotShow) {
  Drawn drawn = draw(some_noise(1), 30, 7);
  const NoiseModel plain = fit_noise(drawn.data()).noise;
  Random random(1, 2);
  for (double& r : drawn.residual)
    r *= 1 + 1e-7 * random.normal();
  expect_alike(fit_noise(drawn.data()).noise, plain, 1e-4);
}

TEST(NoiseModel, IsTheSameForExperimentsInAnotherOrder) {
  const Drawn drawn = draw(some_noise(1), 30, 7);
  Drawn other = drawn;
  for (Index e = 0; e < 30; ++e) {
    const Index from = (7 * e + 3) % 30;
    other.residual.segment(25 * e, 25) = drawn.residual.segment(25 * from, 25);
    other.tau.segment(25 * e, 25) = drawn.tau.segment(25 * from, 25);
  }
  // A change of order is a change of rounding.
  expect_alike(fit_noise(other.data()).noise, fit_noise(drawn.data()).noise, 1e-4);
}

TEST(NoiseModel, LetsGoOfAnEffectThatHasBecomeKnown) {
  Drawn drawn = draw(some_noise(1), 30, 7);
  const VectorXd without = drawn.residual;
  for (Index e = 0; e < 30; ++e) // half of the tests 80 % higher
    drawn.residual.segment(25 * e, 25) += (e % 2 ? 0.4 : -0.4) * drawn.tau.segment(25 * e, 25);
  const NoiseModel swallowed = fit_noise(drawn.data()).noise;
  EXPECT_GT(swallowed.gain, 0.3);
  drawn.residual = without;
  const stats::NoiseFit fresh = fit_noise(drawn.data());
  // 0.01 of log likelihood: nothing that a choice between laws could see.
  EXPECT_NEAR(stats::refit_noise(drawn.data(), swallowed).log_likelihood, fresh.log_likelihood,
              0.01);
  NoiseModel near = fresh.noise;
  near.gain *= 1.3;
  EXPECT_NEAR(stats::refine_noise(drawn.data(), near).log_likelihood, fresh.log_likelihood, 0.01);
  // To what weights can show: 0.5 is one standard error of one parameter.
  near.gain = swallowed.gain;
  EXPECT_NEAR(stats::refit_noise_coarsely(drawn.data(), near).log_likelihood, fresh.log_likelihood,
              0.5);
}

TEST(NoiseModel, RestrictedLikelihoodIsNotFooledByFittedParameters) {
  const NoiseModel truth = some_noise(0);
  double plain = 0, restricted = 0;
  constexpr int campaigns = 10;
  for (std::uint64_t seed = 1; seed <= campaigns; ++seed) {
    Drawn drawn = draw(truth, 20, seed);
    MatrixXd fitted = MatrixXd::Zero(drawn.tau.size(), 6); // means of groups of experiments
    for (Index e = 0; e < 20; ++e)
      fitted.col(e % 6).segment(25 * e, 25) = drawn.tau.segment(25 * e, 25);
    const MatrixXd normal = fitted.transpose() * fitted;
    drawn.residual -= fitted * normal.ldlt().solve(fitted.transpose() * drawn.residual);
    plain += std::pow(fit_noise(drawn.data()).noise.gain / truth.gain, 2) / campaigns;
    drawn.fitted = fitted;
    restricted += std::pow(fit_noise(drawn.data()).noise.gain / truth.gain, 2) / campaigns;
  }
  EXPECT_LT(plain, 0.85) << "6 of 20 degrees of freedom are gone";
  // Two standard errors of a variance from 10 times 14 degrees of freedom.
  EXPECT_NEAR(restricted, 1, 0.25);
}

const std::vector<std::size_t> by_name = [] {
  std::vector<std::size_t> order(81);
  std::iota(order.begin(), order.end(), 0);
  return order;
}();

TEST(OrderOfTests, WhiteScoresHaveNoStructure) {
  int small = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed, 3);
    VectorXd scores(81);
    for (double& score : scores)
      score = random.normal();
    if (test_order(scores, by_name, 199, seed).p_value <= 0.05) ++small;
  }
  // Binomial, 200 trials at 0.05: 99.9 % lie below 21.
  EXPECT_LE(small, 20);
}

TEST(OrderOfTests, DriftAndBatchesAreSeenInAnyFileOrder) {
  for (const bool batch : {false, true}) {
    Random random(7, batch);
    VectorXd scores(81);
    std::vector<std::size_t> order(81);
    for (std::size_t e = 0; e < 81; ++e) {
      order[(e * 40) % 81] = e;
      const auto place = static_cast<double>((e * 40) % 81);
      scores(e) = random.normal() +
                  (batch ? (static_cast<int>(place) / 20 % 2 ? 1.2 : -1.2) : 0.04 * (place - 40));
    }
    EXPECT_LT(test_order(scores, order, 999, 1).p_value, 0.01) << batch;
  }
}

TEST(OrderOfTests, BatchesOfNineAreSeenInMostCampaigns) {
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed, 4);
    VectorXd scores(81);
    double batch = 0;
    for (Index e = 0; e < 81; ++e) {
      if (e % 9 == 0) batch = 1.0 * random.normal();
      scores(e) = batch + random.normal();
    }
    if (test_order(scores, by_name, 199, seed).p_value <= 0.01) ++seen;
  }
  EXPECT_GE(seen, 60);
}

TEST(OrderOfTests, SaysWhichOfSeveralScoresFollowsTheOrder) {
  Random random(9, 1);
  MatrixXd scores(81, 3);
  for (Index e = 0; e < 81; ++e)
    for (Index c = 0; c < 3; ++c)
      scores(e, c) = random.normal() + (c == 1 ? 0.04 * (static_cast<double>(e) - 40) : 0.0);
  const trace::OrderTest test = test_order(scores, by_name, 999, 1);
  EXPECT_LT(test.p_value, 0.01);
  EXPECT_EQ(test.column, 1);
}

} // namespace
} // namespace frictab::trace_noise_test
