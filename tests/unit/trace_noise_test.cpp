// The noise model of the trace stage: weights are V^-1/2, and its parameters are found again.
#include <cmath>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "core/random.h"
#include "trace/noise.h"
#include "trace/order.h"

namespace frictab {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::vector<std::size_t> experiments = {0, 7, 19, 20, 33};

VectorXd some_tau() {
  VectorXd tau(33);
  for (Index i = 0; i < tau.size(); ++i)
    tau(i) = 60 + 7.0 * static_cast<double>((i * 13) % 11);
  return tau;
}

NoiseModel some_noise(double growth) {
  NoiseModel noise;
  noise.additive = 2;
  noise.coupling = -1;
  noise.multiplicative = 0.07;
  noise.slow = 3;
  noise.rho = 0.8;
  noise.white = 1.5;
  noise.growth = growth;
  noise.scale = 95;
  return noise;
}

// V of one experiment, written out.
MatrixXd dense(const NoiseModel& n, const VectorXd& tau) {
  const Index size = tau.size();
  MatrixXd v(size, size);
  for (Index i = 0; i < size; ++i)
    for (Index j = 0; j < size; ++j) {
      const double within =
          n.slow * n.slow * std::pow(n.rho, std::abs(i - j)) + (i == j ? n.white * n.white : 0.0);
      const double d = std::pow(tau(i) / n.scale, n.growth) * std::pow(tau(j) / n.scale, n.growth);
      v(i, j) = (n.additive + n.coupling * tau(i) / n.scale) *
                    (n.additive + n.coupling * tau(j) / n.scale) +
                n.multiplicative * n.multiplicative * tau(i) * tau(j) + d * within;
    }
  return v;
}

TEST(Whitener, GivesTheInverseCovarianceOfEveryExperiment) {
  for (const double growth : {0.0, 1.0}) {
    const VectorXd tau = some_tau();
    const NoiseModel noise = some_noise(growth);
    const Whitener whitener(noise, tau, experiments);
    MatrixXd x(tau.size(), 3);
    for (Index i = 0; i < x.size(); ++i)
      x(i) = std::sin(1.7 * static_cast<double>(i));
    MatrixXd white = x;
    whitener.apply(white);
    for (std::size_t e = 0; e + 1 < experiments.size(); ++e) {
      const auto begin = static_cast<Index>(experiments[e]);
      const auto count = static_cast<Index>(experiments[e + 1]) - begin;
      const MatrixXd v = dense(noise, tau.segment(begin, count));
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

TEST(Whitener, SinglePrecisionAgrees) {
  const Whitener whitener(some_noise(1), some_tau(), experiments);
  MatrixXd x = MatrixXd::Random(33, 11);
  Eigen::MatrixXf f = x.cast<float>();
  whitener.apply(x);
  whitener.apply(f);
  EXPECT_LT((x - f.cast<double>()).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Whitener, SeesNothingAlongNuisanceColumns) {
  const MatrixXd nuisance = MatrixXd::Random(33, 2);
  const Whitener whitener(some_noise(0), some_tau(), experiments, nuisance);
  MatrixXd x = nuisance * MatrixXd::Random(2, 3);
  whitener.apply(x);
  EXPECT_LT(x.norm(), 1e-9);
}

// Residuals drawn from the model.
struct Drawn {
  VectorXd residual, tau;
  std::vector<std::size_t> first{0};
};

Drawn draw(const NoiseModel& noise, std::size_t count, std::uint64_t seed) {
  constexpr Index size = 55;
  Drawn drawn;
  drawn.residual.resize(static_cast<Index>(count) * size);
  drawn.tau.resize(drawn.residual.size());
  Random random(seed);
  for (std::size_t e = 0; e < count; ++e) {
    const auto begin = static_cast<Index>(e) * size;
    for (Index i = 0; i < size; ++i)
      drawn.tau(begin + i) = noise.scale * (0.6 + 0.8 * random.uniform());
    VectorXd z(size);
    for (Index i = 0; i < size; ++i)
      z(i) = random.normal();
    const Eigen::LLT<MatrixXd> cholesky(dense(noise, drawn.tau.segment(begin, size)));
    drawn.residual.segment(begin, size) = cholesky.matrixL() * z;
    drawn.first.push_back(static_cast<std::size_t>(begin + size));
  }
  return drawn;
}

TEST(NoiseModel, IsFoundAgainFromItsOwnResiduals) {
  for (const double growth : {0.0, 1.0}) {
    NoiseModel truth = some_noise(growth);
    const Drawn drawn = draw(truth, 200, 5);
    truth.scale = drawn.tau.mean();
    const NoiseModel found = first_noise(drawn.residual, drawn.tau, drawn.first, {}).noise;
    // Standard errors: 5 % between 200 experiments, 1 to 2 % within 11,000 blocks.
    EXPECT_EQ(found.growth, growth);
    EXPECT_NEAR(found.between(drawn.tau), truth.between(drawn.tau),
                0.15 * truth.between(drawn.tau));
    EXPECT_NEAR(found.slow, 3, 0.2);
    EXPECT_NEAR(found.rho, 0.8, 0.03);
    EXPECT_NEAR(found.white, 1.5, 0.1);
  }
}

TEST(NoiseModel, RestrictedLikelihoodIsNotFooledByFittedParameters) {
  const NoiseModel truth = some_noise(0);
  double plain = 0, restricted = 0, true_variance = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Drawn drawn = draw(truth, 20, seed);
    MatrixXd fitted(drawn.tau.size(), 6); // means of groups of experiments
    fitted.setZero();
    for (std::size_t e = 0; e < 20; ++e)
      fitted.col(static_cast<Index>(e % 6)).segment(static_cast<Index>(e) * 55, 55) =
          drawn.tau.segment(static_cast<Index>(e) * 55, 55);
    const Whitener whitener(truth, drawn.tau, drawn.first, fitted);
    const MatrixXd normal = fitted.transpose() * fitted;
    drawn.residual -= fitted * normal.ldlt().solve(fitted.transpose() * drawn.residual);
    const auto between = [&](const MatrixXd& jacobian) {
      const NoiseModel n = first_noise(drawn.residual, drawn.tau, drawn.first, jacobian).noise;
      return std::pow(n.between(drawn.tau), 2);
    };
    plain += between({}) / 10;
    restricted += between(fitted) / 10;
    true_variance += std::pow(truth.between(drawn.tau), 2) / 10;
  }
  EXPECT_LT(plain, 0.85 * true_variance) << "6 of 20 degrees of freedom are gone";
  EXPECT_NEAR(restricted, true_variance, 0.25 * true_variance);
}

TEST(OrderOfTests, WhiteScoresHaveNoStructure) {
  int small = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed, 3);
    VectorXd scores(81);
    std::vector<double> order;
    for (Index e = 0; e < 81; ++e) {
      scores(e) = random.normal();
      order.push_back(static_cast<double>(e));
    }
    if (test_order(scores, order, 199, seed).p_value <= 0.05) ++small;
  }
  // Binomial, 200 trials at 0.05: 99.9 % lie below 21.
  EXPECT_LE(small, 20);
}

TEST(OrderOfTests, DriftAndBatchesAreSeenInAnyFileOrder) {
  for (const bool batch : {false, true}) {
    Random random(7, batch);
    VectorXd scores(81);
    std::vector<double> order;
    for (std::size_t e = 0; e < 81; ++e)
      order.push_back(static_cast<double>((e * 40) % 81));
    for (Index e = 0; e < 81; ++e) {
      const double place = order[static_cast<std::size_t>(e)];
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
    std::vector<double> order;
    double batch = 0;
    for (Index e = 0; e < 81; ++e) {
      if (e % 9 == 0) batch = 1.0 * random.normal();
      scores(e) = batch + random.normal();
      order.push_back(static_cast<double>(e));
    }
    if (test_order(scores, order, 199, seed).p_value <= 0.01) ++seen;
  }
  EXPECT_GE(seen, 60);
}

TEST(OrderOfTests, SaysWhichOfSeveralScoresFollowsTheOrder) {
  Random random(9, 1);
  MatrixXd scores(81, 3);
  std::vector<double> order;
  for (Index e = 0; e < 81; ++e) {
    order.push_back(static_cast<double>(e));
    for (Index c = 0; c < 3; ++c)
      scores(e, c) = random.normal() + (c == 1 ? 0.04 * (static_cast<double>(e) - 40) : 0.0);
  }
  const OrderTest test = test_order(scores, order, 999, 1);
  EXPECT_LT(test.p_value, 0.01);
  EXPECT_EQ(test.column, 1);
}

} // namespace
} // namespace frictab
