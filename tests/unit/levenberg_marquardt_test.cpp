// Levenberg-Marquardt on problems whose optimum is known.
#include "stats/levenberg_marquardt.h"

#include <cmath>

#include <gtest/gtest.h>

namespace frictab::levenberg_marquardt_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using stats::FitEnding;
using stats::LevenbergMarquardtFit;
using stats::LevenbergMarquardtOptions;
using stats::ParameterRange;

// Half the squares of residuals r(p), whose derivatives are -J.
class Squares : public stats::LeastSquares {
public:
  virtual VectorXd residuals(const VectorXd& p, MatrixXd* jacobian) const = 0;

  double cost(std::span<const double> p) override {
    ++costs;
    return finite(residuals(stats::as_vector(p), nullptr).squaredNorm() / 2);
  }
  stats::NormalEquations normal_equations(std::span<const double> p) override {
    ++linearised;
    MatrixXd j;
    const VectorXd r = residuals(stats::as_vector(p), &j);
    return {finite(r.squaredNorm() / 2), j.transpose() * r, j.transpose() * j};
  }

  int costs = 0, linearised = 0;

private:
  static double finite(double cost) {
    return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
  }
};

// (1 - p0)^2 + 100 (p1 - p0^2)^2: a curved valley, least at (1, 1).
class Rosenbrock : public Squares {
public:
  VectorXd residuals(const VectorXd& p, MatrixXd* jacobian) const override {
    if (jacobian) *jacobian = MatrixXd{{1, 0}, {20 * p(0), -10}};
    return VectorXd{{1 - p(0), 10 * (p(1) - p(0) * p(0))}};
  }
};

// y = p0 exp(-p1 x) at x = 0, 1/2, ... 5.
class Decay : public Squares {
public:
  explicit Decay(VectorXd measured) : measured_(std::move(measured)) {}
  static VectorXd predicted(double scale, double rate) {
    return scale * (-rate * VectorXd::LinSpaced(11, 0, 5).array()).exp();
  }
  VectorXd residuals(const VectorXd& p, MatrixXd* jacobian) const override {
    const VectorXd y = predicted(p(0), p(1));
    if (jacobian) {
      jacobian->resize(y.size(), 2);
      jacobian->col(0) = y / p(0);
      jacobian->col(1) = -y.cwiseProduct(VectorXd::LinSpaced(11, 0, 5));
    }
    return measured_ - y;
  }

private:
  VectorXd measured_;
};

// With and without the correction, and as the stages of tracing and of the network use it.
std::vector<LevenbergMarquardtOptions> ways() {
  LevenbergMarquardtOptions plain, constant;
  plain.learns_curvature = false;
  constant = plain;
  constant.promise_ends = false;
  constant.small_gains_end = 1;
  constant.unit = stats::DampingUnit::current_diagonal;
  constant.fall = 0.2;
  constant.growth = 8;
  constant.growth_of_growth = 1;
  constant.clamps_at_bounds = true;
  constant.derivatives_at_first_trial = false;
  return {{}, plain, constant};
}

const std::vector<ParameterRange> unbounded(2);

class LevenbergMarquardt : public testing::TestWithParam<LevenbergMarquardtOptions> {};
std::string name_of(const testing::TestParamInfo<LevenbergMarquardtOptions>& of) {
  return of.param.learns_curvature ? "Corrected" : of.param.promise_ends ? "Plain" : "Constant";
}
INSTANTIATE_TEST_SUITE_P(Ways, LevenbergMarquardt, testing::ValuesIn(ways()), name_of);

TEST_P(LevenbergMarquardt, FollowsACurvedValleyToItsEnd) {
  Rosenbrock problem;
  LevenbergMarquardtOptions options = GetParam();
  options.exact_cost = 1e-26;
  const LevenbergMarquardtFit fit =
      stats::levenberg_marquardt(problem, unbounded, {-1.2, 1}, options);
  EXPECT_NEAR(fit.parameters[0], 1, 1e-7);
  EXPECT_NEAR(fit.parameters[1], 1, 1e-7);
  EXPECT_LT(problem.costs + problem.linearised, 100);
}

TEST_P(LevenbergMarquardt, FindsTheRateAndTheScaleOfADecayOverDecades) {
  Decay problem(Decay::predicted(2e-4, 0.7));
  const std::vector<ParameterRange> ranges = {{1e-9, 1e3, true}, {0, 10}};
  LevenbergMarquardtOptions options = GetParam();
  options.exact_cost = 1e-34;
  const LevenbergMarquardtFit fit = stats::levenberg_marquardt(problem, ranges, {10, 0}, options);
  EXPECT_NEAR(fit.parameters[0] / 2e-4, 1, 1e-9);
  EXPECT_NEAR(fit.parameters[1], 0.7, 1e-9);
}

// At the bound 0.5 of the rate, the scale is that of the linear fit.
TEST_P(LevenbergMarquardt, FitsTheOthersWhereOneIsHeldByItsBound) {
  const VectorXd measured = Decay::predicted(3, 0.7);
  Decay problem(measured);
  const std::vector<ParameterRange> ranges = {{}, {0, 0.5}};
  const LevenbergMarquardtFit fit =
      stats::levenberg_marquardt(problem, ranges, {1, 0.1}, GetParam());
  const VectorXd shape = Decay::predicted(1, 0.5);
  EXPECT_EQ(fit.parameters[1], 0.5);
  EXPECT_NEAR(fit.parameters[0], measured.dot(shape) / shape.squaredNorm(), 1e-9);
  EXPECT_GT(fit.cost, 1e-3);
}

// The least squares of an outlier are large; the optimum has a gradient of 0 all the same.
TEST_P(LevenbergMarquardt, EndsWhereTheGradientVanishesAlsoWithLargeResiduals) {
  VectorXd measured = Decay::predicted(3, 0.7);
  measured(6) += 2;
  Decay problem(measured);
  const LevenbergMarquardtFit fit =
      stats::levenberg_marquardt(problem, unbounded, {1, 0.1}, GetParam());
  const stats::NormalEquations n = problem.normal_equations(fit.parameters);
  for (Eigen::Index i = 0; i < 2; ++i)
    EXPECT_LT(std::abs(n.descent(i)) / std::sqrt(n.hessian(i, i) * n.cost), 1e-4);
}

TEST_P(LevenbergMarquardt, StopsWhereItsObserverHasSeenEnough) {
  Rosenbrock problem;
  LevenbergMarquardtOptions options = GetParam();
  std::vector<double> costs;
  options.goes_on = [&](std::span<const double> p) {
    costs.push_back(problem.cost(p));
    return costs.size() < 4;
  };
  const LevenbergMarquardtFit fit =
      stats::levenberg_marquardt(problem, unbounded, {-1.2, 1}, options);
  EXPECT_EQ(fit.ending, FitEnding::observer);
  ASSERT_EQ(costs.size(), 4u);
  EXPECT_EQ(costs.back(), fit.cost);
  EXPECT_TRUE(std::is_sorted(costs.rbegin(), costs.rend())) << "each accepted step is better";
}

TEST_P(LevenbergMarquardt, CountsAcceptedStepsAndTrials) {
  Rosenbrock problem;
  LevenbergMarquardtOptions options = GetParam();
  options.most_steps = 3;
  EXPECT_EQ(stats::levenberg_marquardt(problem, unbounded, {-1.2, 1}, options).ending,
            FitEnding::most_steps);
  options.most_steps = 200;
  options.most_trials = 5;
  EXPECT_EQ(stats::levenberg_marquardt(problem, unbounded, {-1.2, 1}, options).ending,
            FitEnding::most_trials);
}

TEST(LevenbergMarquardtCorrection, SavesStepsWhereResidualsAreLarge) {
  VectorXd measured = Decay::predicted(3, 0.7);
  measured(6) += 2;
  int linearised[2];
  for (const bool learns : {false, true}) {
    Decay problem(measured);
    LevenbergMarquardtOptions options{.tolerance = 1e-14};
    options.learns_curvature = learns;
    stats::levenberg_marquardt(problem, unbounded, {1, 0.1}, options);
    linearised[learns] = problem.linearised;
  }
  EXPECT_LT(linearised[1], linearised[0]);
}

TEST(LevenbergMarquardtEnd, SaysWhyThereIsNothingToDo) {
  Decay problem(Decay::predicted(3, 0.7));
  const auto ending = [&](std::vector<ParameterRange> ranges, std::vector<double> start) {
    return stats::levenberg_marquardt(problem, ranges, std::move(start), {.exact_cost = 1e-26})
        .ending;
  };
  EXPECT_EQ(ending({{}, {}}, {3, 0.7}), FitEnding::exact);
  EXPECT_EQ(ending({{0, 1}, {1, 2}}, {1, 1}), FitEnding::nothing_free);
  EXPECT_EQ(ending({{}, {}}, {3, -1e3}), FitEnding::not_finite);
}

TEST(LevenbergMarquardtEnd, KnowsParametersWithoutInfluence) {
  class Constant : public Squares {
    VectorXd residuals(const VectorXd&, MatrixXd* jacobian) const override {
      if (jacobian) *jacobian = MatrixXd::Zero(1, 2);
      return VectorXd::Ones(1);
    }
  } problem;
  const LevenbergMarquardtFit fit = stats::levenberg_marquardt(problem, unbounded, {1, 1});
  EXPECT_EQ(fit.ending, FitEnding::nothing_free);
  EXPECT_FALSE(fit.influence);
}

} // namespace
} // namespace frictab::levenberg_marquardt_test
