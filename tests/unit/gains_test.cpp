// Gains of tests, with their variances.
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "trace/judge/gains.h"

namespace frictab::gains_test {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(TestGains, AreMeansOfLogarithmsWithTheirVariance) {
  Random random(5, 6);
  std::vector<std::size_t> first = {0};
  std::vector<double> measured, predicted;
  for (std::size_t e = 0; e < 200; ++e) {
    const std::size_t rows = e % 2 ? 100 : 6; // the short ones borrow their variance
    for (std::size_t i = 0; i < rows; ++i) {
      predicted.push_back(50 + static_cast<double>(i));
      measured.push_back(predicted.back() * std::exp(0.1 * random.normal()));
    }
    first.push_back(measured.size());
  }
  data::Dataset data;
  data.experiments.resize(200);
  data.first_row = first;
  data.columns = {{"tau_R_MPa", "MPa", measured, {}}};
  const trace::TestGains gains = trace::test_gains(data, predicted);
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i)
    sum += std::log(measured[i] / predicted[i]) / 6;
  EXPECT_NEAR(gains.gain(0), sum, 1e-12);
  double large = 0, small = 0;
  for (Index e = 0; e < 200; e += 2) {
    small += gains.variance(e) / 100;
    large += gains.variance(e + 1) / 100;
  }
  EXPECT_NEAR(large * 100, 0.01, 0.0015); // 3 standard errors: 100 tests, 9 degrees of freedom each
  EXPECT_NEAR(small * 6, 0.01, 0.0015);   // (the median of a chi-square of 9 is 7 % below its mean)
}

TEST(TestGains, ScatterBetweenIsWhatTheirVarianceLeavesOver) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed, 21);
    VectorXd gain(40), variance(40);
    for (Index i = 0; i < gain.size(); ++i) {
      variance(i) = i % 2 ? 0.04 : 1e-4;
      gain(i) = 0.05 * random.normal() + std::sqrt(variance(i)) * random.normal();
    }
    sum += trace::scatter_between(gain, variance, MatrixXd::Ones(40, 1)) / 20;
  }
  // A variance from 20 times 20 tests that count: 3 standard errors are 21 %, Paule and Mandel's
  // weights lose a little.
  EXPECT_NEAR(std::sqrt(sum), 0.05, 0.008);
}

} // namespace
} // namespace frictab::gains_test
