// The restricted likelihood: its value, its derivatives, its search.
#include "stats/reml.h"

#include <cmath>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "core/random.h"
#include "stats/random_effects.h"

namespace frictab::reml_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Experiments of 3, 1 and 4 rows; an intercept and three terms, of which two form a ridge.
class Reml : public testing::Test {
protected:
  Reml() : design(8, 4), y(8) {
    Random random(11);
    for (Index i = 0; i < 8; ++i) {
      design.row(i) << 1, random.normal(), random.normal(), random.normal();
      y(i) = 2 + random.normal();
    }
  }

  MatrixXd covariance(std::size_t e) const {
    const Index size = first[e + 1] - first[e];
    return MatrixXd::Constant(size, size, 0.3) + MatrixXd(0.5 * MatrixXd::Identity(size, size));
  }
  stats::DenseReml with(const VectorXd& precision, double more = 0, std::size_t where = 0) const {
    return {{design, y, first},
            [=, this](std::size_t e) {
              return MatrixXd(covariance(e).array() + (e == where ? more : 0.0));
            },
            precision};
  }

  MatrixXd design;
  VectorXd y;
  std::vector<Index> first = {0, 3, 4, 8};
  const VectorXd ridge{{0, 0, 4, 9}};
};

// A ridge is a covariance of the rows: y has V + A T A' about the free coefficients.
TEST_F(Reml, CountsAPenalisedCoefficientAsNoise) {
  MatrixXd v = MatrixXd::Zero(8, 8);
  for (std::size_t e = 0; e < 3; ++e)
    v.block(first[e], first[e], first[e + 1] - first[e], first[e + 1] - first[e]) = covariance(e);
  const MatrixXd terms = design.rightCols(2);
  v += terms * VectorXd{{1 / 4.0, 1 / 9.0}}.asDiagonal() * terms.transpose();
  const MatrixXd free = design.leftCols(2), w = v.inverse();
  const MatrixXd information = free.transpose() * w * free;
  const VectorXd right = free.transpose() * w * y, b = information.ldlt().solve(right);
  const double expected = (std::log(v.determinant()) + std::log(information.determinant()) +
                           y.dot(w * y) - b.dot(right)) /
                          2;
  const stats::DenseReml reml = with(ridge);
  EXPECT_NEAR(reml.criterion(), expected, 1e-10);
  EXPECT_LT((reml.coefficients().head(2) - b).norm(), 1e-10);
}

TEST_F(Reml, HasTheSlopesOfCentralDifferences) {
  const stats::DenseReml reml = with(ridge);
  constexpr double step = 1e-5;
  for (std::size_t e = 0; e < 3; ++e)
    EXPECT_NEAR(reml.slope(e).sum(),
                (with(ridge, step, e).criterion() - with(ridge, -step, e).criterion()) / (2 * step),
                1e-7);
  for (Index c = 0; c < 4; ++c) {
    VectorXd more = ridge, less = ridge;
    more(c) *= std::exp(-2 * step);
    less(c) *= std::exp(2 * step);
    EXPECT_NEAR(reml.ridge_slopes()(c),
                (with(more).criterion() - with(less).criterion()) / (2 * step), 1e-7);
  }
}

TEST_F(Reml, LeavesAnExperimentOut) {
  const VectorXd without = with(ridge).without(2);
  design.bottomRows(4).setZero();
  y.tail(4).setZero();
  EXPECT_LT((without - with(ridge).coefficients()).norm(), 1e-10);
}

// An estimate is an experiment of one row.
TEST_F(Reml, IsLeastAtTheVarianceBetweenCampaigns) {
  std::vector<stats::Estimate> estimates;
  for (Index i = 0; i < 8; ++i)
    estimates.push_back({y(i), 0.2 + 0.05 * static_cast<double>(i), 0, 0});
  const double variance = stats::between_variance(estimates);
  ASSERT_GT(variance, 0);
  first = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  const MatrixXd mean = MatrixXd::Ones(8, 1);
  const stats::DenseReml reml(
      {mean, y, first},
      [&](std::size_t e) {
        return MatrixXd::Constant(1, 1, variance + std::pow(estimates[e].std_error, 2));
      },
      VectorXd::Zero(1));
  double slope = 0;
  for (std::size_t e = 0; e < 8; ++e)
    slope += reml.slope(e)(0, 0);
  EXPECT_NEAR(slope, 0, 1e-6);
}

TEST(LeastCriterion, IsThatOfTheCriterionWithThePrior) {
  for (const bool has_gradient : {false, true}) {
    stats::LogSearch search{.low = {-5, -5}, .high = {5, 0.25}, .prior = {{0, 0}, 2}};
    search.has_gradient = has_gradient;
    search.first_step = 0.1;
    search.tolerance = 1e-14;
    search.most_evaluations = 400;
    const stats::LogMinimum least = stats::least_criterion(
        [](std::span<const double> x, std::span<double> gradient) {
          if (!gradient.empty()) {
            gradient[0] = 2 * (x[0] - 1);
            gradient[1] = 2 * (x[1] - 1);
          }
          return (x[0] - 1) * (x[0] - 1) + (x[1] - 1) * (x[1] - 1);
        },
        {-1, -1}, search);
    EXPECT_NEAR(least.logs[0], 0.5, 1e-5) << "halfway between the two";
    EXPECT_NEAR(least.logs[1], 0.25, 1e-5) << "at the bound";
    EXPECT_NEAR(least.criterion, 0.5 + 0.5625 + 0.0625, 1e-8);
    EXPECT_GT(least.evaluations, 1u);
  }
}

} // namespace
} // namespace frictab::reml_test
