// Orowan's least squares are exact: no grid, however fine, finds anything better.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "calibrate/orowan_optimum.h"
#include "core/random.h"

namespace frictab::orowan_test {

using calibrate::orowan_optimum;
using calibrate::OrowanPoint;

namespace {

struct Rows {
  std::vector<double> sigma_n, k, tau;
  calibrate::OrowanRows view() const { return {sigma_n, k, tau}; }
  double squares(double mu, double m) const {
    double sum = 0;
    for (std::size_t i = 0; i < tau.size(); ++i)
      sum += std::pow(tau[i] - std::min(mu * sigma_n[i], m * k[i]), 2);
    return sum;
  }
};

Rows random_rows(std::uint64_t seed, std::size_t count, double noise) {
  Random random(seed);
  const double mu = random.uniform(0, 0.3), m = random.uniform(0.05, 1);
  Rows rows;
  for (std::size_t i = 0; i < count; ++i) {
    rows.sigma_n.push_back(random.uniform(0, 2500));
    rows.k.push_back(random.uniform(100, 500));
    rows.tau.push_back(
        std::max(0.0, std::min(mu * rows.sigma_n[i], m * rows.k[i]) + noise * random.normal()));
  }
  return rows;
}

TEST(SlowOrowanOptimum, IsNowhereAboveAFineGridOverTheBounds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Rows rows = random_rows(seed, seed % 3 == 0 ? 4 : 25, seed % 2 ? 5 : 80);
    const OrowanPoint best = orowan_optimum(rows.view(), 0).front();
    ASSERT_TRUE(best.mu >= 0 && best.mu <= 1 && best.m >= 0 && best.m <= 1) << seed;
    const double found = rows.squares(best.mu, best.m);
    for (int i = 0; i <= 200; ++i)
      for (int j = 0; j <= 200; ++j) {
        // Twice: over the whole of the bounds, and closely around the optimum.
        const double mu = i / 200.0, m = j / 200.0;
        ASSERT_LE(found, rows.squares(mu, m) * (1 + 1e-9)) << seed;
        const double near_mu = std::clamp(best.mu + 0.001 * (mu - 0.5), 0.0, 1.0);
        const double near_m = std::clamp(best.m + 0.001 * (m - 0.5), 0.0, 1.0);
        ASSERT_LE(found, rows.squares(near_mu, near_m) * (1 + 1e-9)) << seed;
      }
  }
}

TEST(SlowOrowanOptimum, RespectsTheBounds) {
  // mu = 2 and m = 1.5 would fit: both are held at 1.
  Rows rows{{100, 110, 900, 1000}, {300, 310, 100, 110}, {200, 220, 150, 165}};
  const OrowanPoint best = orowan_optimum(rows.view(), 0).front();
  EXPECT_DOUBLE_EQ(best.mu, 1);
  EXPECT_DOUBLE_EQ(best.m, 1);
}

TEST(SlowOrowanOptimum, LeavesFreeWhatTheRowsDoNotTell) {
  Rows coulomb{{100, 200, 300}, {400, 400, 400}, {10, 20, 30}};
  const OrowanPoint slides = orowan_optimum(coulomb.view(), 0).front();
  EXPECT_NEAR(slides.mu, 0.1, 1e-15);
  EXPECT_GT(slides.m * 400, 30.001) << "the limit is out of the way";
  Rows shear{{1000, 2000, 3000}, {400, 300, 350}, {80, 60, 70}};
  const OrowanPoint sticks = orowan_optimum(shear.view(), 0).front();
  EXPECT_NEAR(sticks.m, 0.2, 1e-15);
  EXPECT_GT(sticks.mu * 1000, 80.001) << "Coulomb friction is out of the way";
}

TEST(SlowOrowanOptimum, DoesNotDependOnTheOrderOfRowsOrOnRatiosThatAgree) {
  Rows rows = random_rows(7, 300, 10);
  for (std::size_t i = 0; i < 300; i += 2) { // half of all ratios are 3
    rows.k[i] = 200;
    rows.sigma_n[i] = 600;
  }
  const OrowanPoint best = orowan_optimum(rows.view(), 0).front();
  Rows reversed = rows;
  for (auto* column : {&reversed.sigma_n, &reversed.k, &reversed.tau})
    std::reverse(column->begin(), column->end());
  const OrowanPoint again = orowan_optimum(reversed.view(), 0).front();
  EXPECT_NEAR(again.mu, best.mu, 1e-12);
  EXPECT_NEAR(again.m, best.m, 1e-12);
}

} // namespace
} // namespace frictab::orowan_test
