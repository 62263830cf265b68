// Random-effects summaries against published figures.
#include "stats/random_effects.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace frictab::random_effects_test {
namespace {

using stats::Estimate;

// Log relative risks of 13 BCG vaccine trials and their variances (Colditz et al. 1994).
std::vector<Estimate> bcg() {
  constexpr std::array<double, 13> y = {-0.8893, -1.5854, -1.3481, -1.4416, -0.2175,
                                        -0.7861, -1.6209, 0.0120,  -0.4694, -1.3713,
                                        -0.3394, 0.4459,  -0.0173};
  constexpr std::array<double, 13> v = {0.3256, 0.1946, 0.4154, 0.0200, 0.0512, 0.0069, 0.2230,
                                        0.0040, 0.0564, 0.0730, 0.0124, 0.5325, 0.0714};
  std::vector<Estimate> all;
  for (std::size_t i = 0; i < y.size(); ++i)
    all.push_back({y[i], std::sqrt(v[i]), 0, i});
  return all;
}

TEST(RandomEffects, AreThoseOfMetaforOnTheVaccineTrials) {
  const stats::RandomEffects s = stats::random_effects(bcg());
  EXPECT_EQ(s.campaigns, 13u);
  EXPECT_NEAR(s.between_sd * s.between_sd, 0.3132, 3e-4); // REML
  EXPECT_NEAR(s.mean, -0.7145, 3e-4);
  EXPECT_NEAR(s.interval.low, -1.1082, 2e-3); // Knapp and Hartung
  EXPECT_NEAR(s.interval.high, -0.3208, 2e-3);
  EXPECT_LT(s.predicted.low, s.interval.low);
  EXPECT_GT(s.predicted.high, 0.4);
}

TEST(RandomEffects, KnowNoScatterWhereThereIsNone) {
  std::vector<Estimate> all;
  for (std::size_t i = 0; i < 8; ++i)
    all.push_back({5 + 0.01 * (i % 2 == 0 ? 1 : -1), 0.5, 0, i});
  EXPECT_EQ(stats::between_variance(all), 0);
  const stats::RandomEffects s = stats::random_effects(all);
  EXPECT_NEAR(s.mean, 5, 1e-12);
  EXPECT_GT(s.interval.high - s.interval.low, 0.5) << "the errors alone";
}

TEST(RandomEffects, OfOneOrTwoCampaignsSayNoMoreThanTheseCan) {
  const std::vector<Estimate> two = {{1, 0.1, 0, 0}, {2, 0.1, 0, 1}};
  const stats::RandomEffects s = stats::random_effects(two);
  EXPECT_NEAR(s.mean, 1.5, 1e-12);
  EXPECT_TRUE(std::isfinite(s.interval.low));
  EXPECT_TRUE(std::isnan(s.predicted.low));
  const stats::RandomEffects one = stats::random_effects(std::span(two).first(1));
  EXPECT_EQ(one.mean, 1);
  EXPECT_TRUE(std::isnan(one.interval.low) && std::isnan(one.between_sd));
  EXPECT_TRUE(std::isnan(stats::random_effects({}).mean));
}

TEST(RandomEffects, WithinTheLevelsOfAFactorAreWhatItDoesNotExplain) {
  std::vector<Estimate> all;
  for (std::size_t i = 0; i < 20; ++i)
    all.push_back({(i % 2 == 0 ? 1.0 : 3.0) + 0.01 * static_cast<double>(i % 5), 0.1, i % 2, i});
  EXPECT_EQ(stats::between_variance(all), 0);
  for (Estimate& one : all)
    one.group = 0;
  EXPECT_NEAR(stats::between_variance(all), 20.0 / 19, 0.02) << "of 1 and 3, less the errors";
}

TEST(RandomEffects, NameACampaignThatDoesNotBelongToTheOthers) {
  EXPECT_TRUE(stats::outliers(bcg()).empty());
  std::vector<Estimate> all;
  for (std::size_t i = 0; i < 9; ++i)
    all.push_back({0.1 * static_cast<double>(i), 0.2, 0, i});
  all.push_back({6, 0.2, 0, 9});
  const auto found = stats::outliers(all);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].estimate.campaign, 9u);
  EXPECT_LT(found[0].p_value, 0.001);
  EXPECT_NEAR(found[0].others.mean, 0.4, 1e-9);
}

TEST(RandomEffects, SharesHaveTheIntervalOfWilson) {
  EXPECT_NEAR(stats::share_interval(0, 10).high, 0.2775, 1e-4);
  EXPECT_NEAR(stats::share_interval(5, 10).low, 0.2366, 1e-4);
  EXPECT_NEAR(stats::share_interval(5, 10).high, 0.7634, 1e-4);
}

} // namespace
} // namespace frictab::random_effects_test
