// Comparing laws: what equals stays equal, what differs is found, and chance is given its due.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "calibrate/choice.h"
#include "calibrate/comparison.h"
#include "calibrate/metrics.h"
#include "calibrate/recommended.h"
#include "core/random.h"
#include "support/sample_data.h"
#include "support/threads.h"

namespace frictab::comparison_test {

using calibrate::compare;
using calibrate::Comparisons;
using calibrate::family_sentence;
using calibrate::LawErrors;
using calibrate::Metrics;
using calibrate::metrics;
using calibrate::pairwise_sentence;
using stats::ErrorSums;

namespace {

using testing::ElementsAre;

// An experiment of 50 rows whose mean absolute error is `mae`.
ErrorSums experiment(double mae, double rows = 50) {
  return {mae * rows, 1.5 * mae * mae * rows, 0, rows};
}

LawErrors law(const std::string& name, const std::vector<double>& mae) {
  LawErrors errors{name, {}};
  for (const double value : mae)
    errors.sums.push_back(experiment(value));
  return errors;
}

// Laws whose errors have a part in common and an own one, skewed as absolute errors are, all with
// the same distribution.
std::vector<LawErrors> exchangeable(std::size_t laws, std::size_t experiments, Random& random) {
  std::vector<std::vector<double>> mae(laws);
  for (std::size_t e = 0; e < experiments; ++e) {
    const double common = 8 * std::abs(random.normal());
    for (auto& own : mae)
      own.push_back(1 + std::abs(common + 4 * random.normal()));
  }
  std::vector<LawErrors> errors;
  for (std::size_t l = 0; l < laws; ++l)
    errors.push_back(law("law" + std::to_string(l), mae[l]));
  return errors;
}

TEST(SlowComparison, OfALawWithItselfIsExactlyZero) {
  const std::vector<double> mae{3, 8, 1, 12, 5, 6, 2};
  const Comparisons c = compare(std::vector<LawErrors>{law("a", mae), law("b", mae)}, 500, 1);
  ASSERT_EQ(c.pairs.size(), 1u);
  for (const calibrate::Difference& d : {c.pairs[0].mae, c.pairs[0].rmse}) {
    EXPECT_EQ(d.value_MPa, 0);
    EXPECT_EQ(d.interval.low, 0);
    EXPECT_EQ(d.interval.high, 0);
    EXPECT_EQ(d.p_value, 1);
    EXPECT_FALSE(d.distinguishable());
  }
  EXPECT_THAT(calibrate::possibly_best(c), ElementsAre("a", "b"));
}

// What a fit's tolerance leaves of a law that is written in two ways is without scatter.
TEST(SlowComparison, OfALawWrittenInTwoWaysFindsNoBetterOne) {
  const std::vector<double> mae{13, 18, 11, 12, 15, 16, 12};
  std::vector<double> again = mae;
  for (double& one : again)
    one *= 1 + 2e-5;
  const std::vector<LawErrors> laws{law("a", mae), law("b", again)};
  const Comparisons c = compare(laws, 500, 1);
  EXPECT_EQ(c.pairs[0].mae.p_value, 1);
  EXPECT_THAT(calibrate::possibly_best(c), ElementsAre("a", "b"));
  const std::vector<LawErrors> other_rank{laws[1], laws[0]};
  EXPECT_EQ(calibrate::choose_again(other_rank, 500, 1).best_in[0].share, 1) << "the first of both";
}

TEST(SlowComparison, OfLawsThatCountAsTheSameHasZeroInItsInterval) {
  const std::vector<double> mae{13, 18, 11, 12, 15, 16, 12};
  for (const double scatter : {0.0, 1e-6, 1e-5}) {
    std::vector<double> other = mae;
    for (std::size_t e = 0; e < mae.size(); ++e)
      other[e] *= 1 + 2e-5 + scatter * (e % 2 == 0 ? 1 : -1);
    const Comparisons c = compare(std::vector<LawErrors>{law("a", mae), law("b", other)}, 999, 1);
    for (const calibrate::Difference& d : {c.pairs[0].mae, c.pairs[0].rmse}) {
      EXPECT_EQ(d.p_value, 1) << scatter;
      EXPECT_LE(d.interval.low, 0) << scatter;
      EXPECT_GE(d.interval.high, d.value_MPa) << scatter;
    }
  }
}

// Of forty experiments two tell the laws apart: a resample without them knows nothing, and must not
// say that it knows the difference to any number of digits.
TEST(SlowComparison, OfLawsThatDifferInTwoExperimentsHasAnIntervalOfTheSizeOfWhatTheyDiffer) {
  std::vector<double> mae, other;
  for (int e = 0; e < 40; ++e) {
    mae.push_back(10 + e % 7);
    other.push_back(mae.back() + (e < 2 ? 1 : 1e-8 * (e % 3)));
  }
  const Comparisons c = compare(std::vector<LawErrors>{law("a", mae), law("b", other)}, 999, 1);
  EXPECT_NEAR(c.pairs[0].mae.value_MPa, 0.05, 1e-6);
  EXPECT_LT(c.pairs[0].mae.interval.low, 0) << "two experiments prove nothing";
  EXPECT_GT(c.pairs[0].mae.interval.low, -1);
  EXPECT_LT(c.pairs[0].mae.interval.high, 1);
}

TEST(SlowComparison, OfALawThatIsAlwaysWorseByOneMPaIsOneMPa) {
  std::vector<double> mae{3, 8, 1, 12, 5, 6, 2}, worse = mae;
  for (double& value : worse)
    value += 1;
  const Comparisons c = compare(std::vector<LawErrors>{law("a", mae), law("b", worse)}, 999, 1);
  EXPECT_NEAR(c.pairs[0].mae.value_MPa, 1, 1e-12);
  EXPECT_NEAR(c.pairs[0].mae.interval.low, 1, 1e-9) << "what both share does not widen it";
  EXPECT_NEAR(c.pairs[0].mae.interval.high, 1, 1e-9);
  EXPECT_LT(c.pairs[0].mae.p_value, 0.01);
  EXPECT_THAT(calibrate::possibly_best(c), ElementsAre("a"));
}

TEST(SlowComparison, FindsADifferenceThatTheSeparateIntervalsHide) {
  Random random(5);
  std::vector<double> better, worse;
  std::vector<std::size_t> first_row{0};
  for (int e = 0; e < 30; ++e) {
    better.push_back(2 + 10 * std::abs(random.normal()));
    worse.push_back(better.back() + 1 + 0.5 * random.normal());
  }
  const std::vector<LawErrors> laws{law("a", better), law("b", worse)};
  const Metrics a = metrics(laws[0].sums, 1000, 1), b = metrics(laws[1].sums, 1000, 1);
  EXPECT_GT(a.mae_interval.high, b.mae_MPa);
  EXPECT_TRUE(compare(laws, 1000, 1).pairs[0].mae.distinguishable());
}

TEST(SlowComparison, IntervalLeavesZeroOutExactlyWhereThePValueIsBelowFivePercent) {
  Random random(9);
  int distinguishable = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    const Comparisons c = compare(exchangeable(3, 8, random), 150 + i, i);
    for (const calibrate::Comparison& pair : c.pairs)
      for (const calibrate::Difference& d : {pair.mae, pair.rmse}) {
        EXPECT_EQ(d.interval.low > 0 || d.interval.high < 0, d.distinguishable()) << d.p_value;
        distinguishable += d.distinguishable();
      }
  }
  EXPECT_GT(distinguishable, 5);
}

TEST(SlowComparison, KeepsPairsInTheOrderOfRanks) {
  Random random(1);
  const Comparisons c = compare(exchangeable(4, 10, random), 200, 1);
  std::vector<std::string> pairs;
  for (const calibrate::Comparison& pair : c.pairs)
    pairs.push_back(pair.law + "-" + pair.other);
  EXPECT_THAT(pairs, ElementsAre("law0-law1", "law0-law2", "law0-law3", "law1-law2", "law1-law3",
                                 "law2-law3"));
}

// Kolmogorov-Smirnov: 1.63/sqrt(n) is passed by 1 of 100 uniform samples.
TEST(SlowComparison, PValuesOfEquallyGoodLawsAreUniform) {
  constexpr std::size_t pairs = 200;
  std::vector<double> mae, rmse;
  Random random(11);
  for (std::size_t i = 0; i < pairs; ++i) {
    const Comparisons c = compare(exchangeable(2, 30, random), 500, i);
    mae.push_back(c.pairs[0].mae.p_value);
    rmse.push_back(c.pairs[0].rmse.p_value);
  }
  for (auto* p : {&mae, &rmse}) {
    std::ranges::sort(*p);
    double distance = 0;
    for (std::size_t i = 0; i < pairs; ++i)
      distance = std::max({distance, std::abs((*p)[i] - static_cast<double>(i) / pairs),
                           std::abs((*p)[i] - static_cast<double>(i + 1) / pairs)});
    EXPECT_LT(distance, 1.63 / std::sqrt(static_cast<double>(pairs)));
  }
}

// Differences of which most are nearly alike and few are far off: resamples without these few have
// hardly any scatter, and make a pair's interval wide.
TEST(SlowComparison, TheBestOfAllIsNeverMoreCertainThanThePairsItIsOf) {
  Random random(21);
  int excluded = 0, unclear = 0;
  for (std::uint64_t i = 0; i < 100; ++i) {
    std::vector<double> a, b, c;
    for (int e = 0; e < 12; ++e) {
      a.push_back(10 + random.normal());
      b.push_back(a.back() + 5 + 0.2 * random.normal() + (random.uniform(0, 1) < 0.2 ? 25 : 0));
      c.push_back(a.back() + 0.5 * random.normal());
    }
    const Comparisons found = compare(std::vector{law("a", a), law("b", b), law("c", c)}, 300, i);
    for (std::size_t l = 0; l < 3; ++l) {
      double least = 1; // of the pairs that another law leads
      for (const calibrate::Comparison& pair : found.pairs) {
        const bool leads =
            pair.law == found.laws[l] ? pair.mae.value_MPa < 0 : pair.mae.value_MPa > 0;
        if ((pair.law == found.laws[l] || pair.other == found.laws[l]) && leads)
          least = std::min(least, pair.mae.p_value);
      }
      EXPECT_GE(found.best_p_values[l], least);
      excluded += found.best_p_values[l] < 0.05;
      unclear += l == 1 && least >= 0.05;
    }
  }
  EXPECT_GT(excluded, 50);
  EXPECT_GT(unclear, 5);
}

// Pair by pair, the leader of 8 equally good laws beats one of them far more often than 5 %.
TEST(SlowComparison, DeclaresABestAmongEqualLawsInAtMostFivePercent) {
  constexpr int campaigns = 200;
  Random random(12);
  int first_excluded = 0, one_left = 0, naive = 0;
  for (int i = 0; i < campaigns; ++i) {
    auto laws = exchangeable(8, 30, random);
    const auto mae = [](const LawErrors& l) { return metrics(l.sums, 0, 0).mae_MPa; };
    std::ranges::stable_sort(
        laws, [&](const LawErrors& a, const LawErrors& b) { return mae(a) < mae(b); });
    const Comparisons c = compare(laws, 500, static_cast<std::uint64_t>(i));
    const auto best = calibrate::possibly_best(c);
    first_excluded += std::ranges::find(best, "law0") == best.end();
    one_left += best.size() == 1;
    naive += calibrate::as_good_as_first(c).size() < 7;
  }
  // 5 % and three standard errors of 200 trials.
  EXPECT_LE(first_excluded, 0.096 * campaigns);
  EXPECT_LE(one_left, 0.05 * campaigns);
  EXPECT_GT(naive, 0.2 * campaigns) << "why the family-wise answer is needed";
}

// Laws of every kind of scatter about what they have in common: alike, noisy, skewed, constant but
// for a few tests; `spread` of their true errors.
std::vector<LawErrors> mixed(std::size_t laws, std::size_t experiments, double spread,
                             Random& random) {
  std::vector<double> common;
  for (std::size_t e = 0; e < experiments; ++e)
    common.push_back(10 + 8 * std::abs(random.normal()));
  std::vector<LawErrors> errors;
  for (std::size_t l = 0; l < laws; ++l) {
    const double own = std::pow(10, random.uniform(-2, 0.3));
    const double true_error = spread * static_cast<double>(l);
    const bool skewed = l % 3 == 1, constant = l % 3 == 2;
    std::vector<double> mae;
    for (const double base : common) {
      double x = random.normal();
      if (skewed) x = -std::log(random.uniform(1e-9, 1)) - 1;
      if (constant) x = random.uniform(0, 1) < 0.1 ? -0.9 : 0.1;
      mae.push_back(base + true_error + own * x);
    }
    errors.push_back(law("law" + std::to_string(l), mae));
  }
  return errors;
}

double mae_of(const LawErrors& one) {
  return metrics(one.sums, 0, 0).mae_MPa;
}

void rank(std::vector<LawErrors>& laws) {
  std::ranges::stable_sort(
      laws, [](const LawErrors& a, const LawErrors& b) { return mae_of(a) < mae_of(b); });
}

bool loses_a_pair(const Comparisons& c, const std::string& name) {
  return std::ranges::any_of(c.pairs, [&](const calibrate::Comparison& pair) {
    return pair.other == name && pair.mae.value_MPa > 0 && pair.mae.p_value < 0.05;
  });
}

// Two constants below all that was measured are apart by the same in every test but a few: no
// scatter, and resamples without these few are infinitely sure of anything.
TEST(SlowComparison, ALawThatAllOthersBeatIsOutHoweverAlikeItIsToAThird) {
  Random random(31);
  std::vector<double> traced, mean, low, lower;
  for (int e = 0; e < 108; ++e) {
    const double mu = e % 3 == 0 ? 0.11 + 0.02 * random.normal() : 0.4 + 0.1 * random.normal();
    traced.push_back(0.03 + 0.01 * std::abs(random.normal()));
    mean.push_back(std::abs(mu - 0.3) + 0.02);
    low.push_back(std::abs(mu - 0.08));
    lower.push_back(std::abs(mu - 0.04));
  }
  const std::vector<LawErrors> laws{law("traced", traced), law("mean", mean), law("low", low),
                                    law("lower", lower)};
  const Comparisons c = compare(laws, 1000, 1);
  for (const calibrate::Comparison& pair : c.pairs)
    EXPECT_TRUE(pair.law != "traced" || pair.mae.p_value < 0.005) << pair.other;
  EXPECT_THAT(calibrate::possibly_best(c), ElementsAre("traced"));
}

// No law with a larger error and a certain loss is in while a better one is out.
TEST(SlowComparison, WhatMayBeTheBestFallsWithTheErrorWhereALossIsCertain) {
  Random random(32);
  int in = 0, lost = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    auto laws = mixed(2 + i % 9, 4 + i % 40, 0.2 * static_cast<double>(i % 5), random);
    rank(laws);
    const Comparisons c = compare(laws, 100 + i % 300, i);
    const auto best = calibrate::possibly_best(c);
    EXPECT_EQ(best.front(), c.laws.front());
    for (std::size_t l = 0; l < laws.size(); ++l) {
      if (c.best_p_values[l] < 0.05 || !loses_a_pair(c, c.laws[l])) continue;
      ++in;
      for (std::size_t better = 0; better < l; ++better)
        EXPECT_GE(c.best_p_values[better], 0.05) << "campaign " << i;
    }
    for (const std::string& name : c.laws) // nor is one left out that nobody beats
      if (std::ranges::find(best, name) == best.end()) {
        EXPECT_TRUE(loses_a_pair(c, name));
        ++lost;
      }
  }
  EXPECT_GT(in, 20) << "laws that owe their place to their number";
  EXPECT_GT(lost, 200);
}

// Laws of any scatter, all equally good: how often one of them is left out. Of what happens in one
// test of ten, which is the third kind, 8 tests hold nothing in 43 of 100 campaigns: no resample
// knows of it, and there such a law is left out too often.
TEST(SlowComparison, KeepsAnEquallyGoodLawInWithAtLeast95Percent) {
  constexpr int campaigns = 300;
  for (const std::size_t experiments : {8, 12, 30}) {
    Random random(33);
    std::array<std::size_t, 3> out{}, all{}; // by kind of scatter
    for (int i = 0; i < campaigns; ++i) {
      const Comparisons c =
          compare(mixed(8, experiments, 0, random), 400, static_cast<std::uint64_t>(i));
      for (std::size_t l = 0; l < c.laws.size(); ++l) {
        out[l % 3] += c.best_p_values[l] < 0.05;
        ++all[l % 3];
      }
    }
    const char* kinds[] = {"normal", "skewed", "rare"};
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const double share = static_cast<double>(out[kind]) / static_cast<double>(all[kind]);
      RecordProperty(fmt::format("left_out_{}_of_{}_tests", kinds[kind], experiments),
                     fmt::format("{:.3f}", share));
      if (kind < 2 || experiments == 30) {
        EXPECT_LE(share, 0.05) << kinds[kind] << experiments;
      }
    }
  }
}

TEST(SlowComparison, ALawThatIsNoCandidateIsComparedAndCannotBeTheBest) {
  Random random(34);
  auto laws = exchangeable(4, 20, random);
  rank(laws);
  const Comparisons with = compare(laws, 300, 1);
  laws.front().candidate = false;
  const Comparisons c = compare(laws, 300, 1);
  EXPECT_EQ(c.pairs.size(), 6u);
  EXPECT_TRUE(std::isnan(c.best_p_values.front()));
  EXPECT_EQ(c.best_p_values[1], 1) << "the best of those that compete";
  EXPECT_EQ(calibrate::possibly_best(c).front(), c.laws[1]);
  EXPECT_THAT(family_sentence(c, false), testing::HasSubstr("3 laws compared together"));
  EXPECT_EQ(pairwise_sentence(c).find(c.laws[1]), 0u);
  EXPECT_EQ(pairwise_sentence(c).find(c.laws.front()), std::string::npos);
  EXPECT_EQ(c.pairs.front().mae.p_value, with.pairs.front().mae.p_value);
}

TEST(Recommended, IsTheSimplestLawWithinOneStandardErrorOfTheBest) {
  const std::vector<double> best{3, 8, 1, 12, 5, 6, 2};
  std::vector<double> near = best, far = best;
  for (std::size_t e = 0; e < best.size(); ++e) {
    near[e] += e % 2 == 0 ? 1.0 : -0.9; // 0.19 behind, standard error 0.39
    far[e] += e % 2 == 0 ? 1.0 : 0.2;   // 0.66 behind, 0.16
  }
  const std::vector<LawErrors> laws{law("net", best), law("near", near), law("far", far)};
  const std::vector<std::size_t> numbers{1140, 3, 1};
  const calibrate::Recommended r = calibrate::recommend(laws, numbers);
  EXPECT_EQ(r.law, "near");
  EXPECT_EQ(r.best, "net");
  EXPECT_EQ(r.numbers, 3u);
  EXPECT_EQ(r.numbers_of_best, 1140u);
  double mean = 0, square = 0;
  for (std::size_t e = 0; e < best.size(); ++e)
    mean += (near[e] - best[e]) / 7;
  for (std::size_t e = 0; e < best.size(); ++e)
    square += std::pow(near[e] - best[e] - mean, 2);
  EXPECT_NEAR(r.behind_MPa, mean, 1e-12);
  EXPECT_NEAR(r.std_error_MPa, std::sqrt(square / 6 / 7), 1e-12) << "of the mean of 7 differences";
}

TEST(Recommended, OfEquallySimpleLawsIsTheOneWithTheSmallerErrorAndTheBestWhereNoneIsSimpler) {
  const std::vector<double> best{3, 8, 1, 12}, near{4, 7.2, 1, 12.1}, nearer{3.8, 7.3, 1, 12.1};
  const std::vector<LawErrors> laws{law("a", best), law("b", near), law("c", nearer)};
  EXPECT_EQ(calibrate::recommend(laws, std::vector<std::size_t>{5, 2, 2}).law, "c");
  EXPECT_EQ(calibrate::recommend(laws, std::vector<std::size_t>{2, 2, 2}).law, "a");
  EXPECT_EQ(calibrate::recommend(laws, std::vector<std::size_t>{1, 2, 3}).law, "a");
  const std::vector<LawErrors> of_one_test{law("a", {3}), law("b", {3})};
  EXPECT_EQ(calibrate::recommend(of_one_test, std::vector<std::size_t>{5, 1}).law, "a");
}

// What a fit's tolerance leaves apart is no loss, however surely.
TEST(Recommended, TakesTheSimplerOfTwoWaysToWriteALaw) {
  const std::vector<double> mae{13, 18, 11, 12, 15, 16, 12};
  std::vector<double> again = mae;
  for (double& one : again)
    one *= 1 + 2e-5;
  const std::vector<LawErrors> laws{law("long", mae), law("short", again)};
  EXPECT_EQ(calibrate::recommend(laws, std::vector<std::size_t>{3, 2}).law, "short");
}

TEST(SlowComparison, IsTheSameForAnyNumberOfThreads) {
  Random random(3);
  const auto laws = exchangeable(5, 12, random);
  const auto text = [&] {
    calibrate::Calibration calibration;
    calibration.comparisons = compare(laws, 300, 1);
    return calibrate::calibration_json(calibration);
  };
  EXPECT_EQ(test::with_threads(1, text), test::with_threads(2, text));
}

TEST(SlowComparison, OfOneExperimentOrWithoutResamplesIsNotMade) {
  const std::vector<LawErrors> one{law("a", {3}), law("b", {4})};
  EXPECT_TRUE(compare(one, 500, 1).pairs.empty());
  const std::vector<LawErrors> two{law("a", {3, 4}), law("b", {4, 9})};
  EXPECT_TRUE(compare(two, 0, 1).pairs.empty());
  EXPECT_EQ(pairwise_sentence(compare(one, 500, 1)), "");
  EXPECT_EQ(family_sentence(compare(one, 500, 1), true), "");
}

TEST(SlowComparison, IsSaidInTheseWords) {
  Comparisons c;
  c.laws = {"a", "b", "c"};
  c.best_p_values = {1, 0.3, 0.01};
  c.pairs = {{"a", "b", {1, {-1, 3}, 0.3}, {}},
             {"a", "c", {9, {7, 11}, 0.001}, {}},
             {"b", "c", {8, {6, 10}, 0.001}, {}}};
  EXPECT_EQ(pairwise_sentence(c), "a is significantly better than 1 of 2 other laws (95 % per "
                                  "pair, paired by experiment); tied "
                                  "with: b");
  EXPECT_EQ(family_sentence(c, true),
            "not ruled out as best (95 %, 3 laws compared together): 2 of 3 (a, b)");
  c.pairs[0].mae.p_value = 0.01;
  c.best_p_values[1] = 0.02;
  EXPECT_EQ(
      pairwise_sentence(c),
      "a is significantly better than 2 of 2 other laws (95 % per pair, paired by experiment)");
  EXPECT_EQ(family_sentence(c, false),
            "not ruled out as best (95 %, 3 laws compared together): 1 of 3 (a)");
  c.pairs[0].mae.p_value = c.pairs[1].mae.p_value = 0.5;
  c.best_p_values = {1, 0.5, 0.5};
  EXPECT_EQ(pairwise_sentence(c), "a is not distinguishable from any other law (95 % per pair, "
                                  "paired by experiment)");
  EXPECT_EQ(family_sentence(c, false),
            "not ruled out as best (95 %, 3 laws compared together): 3 of 3");
}

TEST(Metrics, IntervalsHoldTheTruthIn90To98OfAHundredCampaignsOf30Experiments) {
  // A law without its experiments' gains: tau 80..160 MPa, gain 8.6 %, slow and white noise.
  const auto campaign = [](std::size_t experiments, Random& random) {
    std::vector<ErrorSums> sums(experiments);
    for (ErrorSums& one : sums) {
      const double tau = random.uniform(80, 160), gain = 0.086 * random.normal();
      for (int i = 0; i < 20; ++i) {
        const double r = tau * (gain + 0.034 * random.normal());
        one.absolute += std::abs(r);
        one.square += r * r;
        one.residual += r;
        ++one.rows;
      }
    }
    return sums;
  };
  Random random(7);
  const Metrics truth = metrics(campaign(200'000, random), 0, 1);
  int mae = 0, rmse = 0, bias = 0;
  const auto holds = [](const calibrate::Interval& i, double value) {
    return i.low <= value && value <= i.high;
  };
  for (std::uint64_t c = 0; c < 200; ++c) {
    const Metrics m = metrics(campaign(30, random), 999, c);
    mae += holds(m.mae_interval, truth.mae_MPa);
    rmse += holds(m.rmse_interval, truth.rmse_MPa);
    bias += holds(m.bias_interval, 0);
  }
  for (const int held : {mae, rmse, bias}) {
    EXPECT_GE(held, 180);
    EXPECT_LE(held, 196);
  }
}

TEST(Metrics, HaveNoIntervalOfOneExperimentAndAWideOneOfTwo) {
  const std::vector<ErrorSums> one{experiment(3)}, two{experiment(3), experiment(5)};
  EXPECT_TRUE(std::isnan(metrics(one, 500, 1).mae_interval.low));
  const Metrics m = metrics(two, 500, 1);
  EXPECT_NEAR(m.mae_interval.high, 4 + 12.706, 0.01) << "Student's t, one degree of freedom";
  EXPECT_EQ(m.mae_interval.low, 0) << "an error is not negative";
}

} // namespace
} // namespace frictab::comparison_test
