// Tests that stand apart: found, and not found where there are none.
#include <algorithm>
#include <cmath>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/tests_apart.h"
#include "support/gain_campaign.h"
#include "twin/twin.h"

namespace frictab::tests_apart_test {

using data::Dataset;
using data::find_tests_apart;
using test::GainCampaign;

namespace {

constexpr std::size_t campaigns = 100;

Dataset with_test_at(Dataset data, std::size_t test, double factor) {
  for (data::Column& column : data.columns)
    for (std::size_t i = data.first_row[test];
         column.name == "tau_R_MPa" && i < data.first_row[test + 1]; ++i)
      column.values[i] *= factor;
  return data;
}

// Of campaigns whose test 3 is off by a factor: how often it, and any other, is named.
std::pair<std::size_t, std::size_t> named(double factor, std::size_t tests = 12) {
  std::size_t hit = 0, others = 0;
  for (std::size_t seed = 1; seed <= campaigns; ++seed)
    for (const auto& one :
         find_tests_apart(with_test_at(GainCampaign::spread(tests, seed).data(), 3, factor)))
      (one.test == 3 && factor != 1 ? hit : others) += 1;
  return {hit, others};
}

TEST(TestsApart, AtHalfOrTwiceTheirStressAreFound) {
  const Dataset half = with_test_at(GainCampaign::spread(12, 1).data(), 3, 0.5);
  const auto found = find_tests_apart(half);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].test, 3U);
  EXPECT_NEAR(found[0].factor, 0.5, 0.1);
  for (const double factor : {0.5, 2.0, 2.98}) {
    const auto [hit, others] = named(factor);
    EXPECT_GE(hit, 90U) << factor;
    EXPECT_LE(others, 3U) << factor;
  }
  EXPECT_GE(named(0.5, 40).first, 98U);
}

// A mixture that one test alone has may be the reason; a number that each test has for itself,
// none.
TEST(TestsApart, OfALevelOfTheirOwnAreNotCalledThat) {
  Dataset data = with_test_at(GainCampaign::spread(12, 1).data(), 3, 0.5);
  const auto add = [&](const std::function<double(std::size_t)>& level) {
    data.columns.push_back({"ptfe_pct", "", {}, {}, {}, {}});
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      data.columns.back().values.resize(data.first_row[e + 1], level(e));
  };
  add([](std::size_t e) { return e == 3 ? 15 : double(30 + 15 * (e % 2)); });
  EXPECT_EQ(find_tests_apart(data).size(), 0U);
  data.columns.pop_back();
  add([](std::size_t e) { return double(e); });
  EXPECT_EQ(find_tests_apart(data).size(), 1U);
}

// A verdict follows from what the test showed; so does a remark.
TEST(TestsApart, WhoseOwnLevelIsAVerdictAreCalledThat) {
  const Dataset off = with_test_at(GainCampaign::spread(12, 1).data(), 3, 2.4);
  for (const auto& [name, own, others, found] :
       {std::tuple("valid", "FALSE", "TRUE", 1U), std::tuple("comment", "slipped", "", 1U),
        std::tuple("check", "nok", "ok", 1U), std::tuple("lubricated", "FALSE", "TRUE", 0U),
        std::tuple("oil", "B", "A", 0U)}) {
    Dataset data = off;
    data::Column column{name, "", {}, {own, others}, {}, {}};
    std::sort(column.levels.begin(), column.levels.end());
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      column.values.resize(data.first_row[e + 1],
                           column.levels[0] == (e == 3 ? own : others) ? 0 : 1);
    data.columns.push_back(column);
    EXPECT_EQ(find_tests_apart(data).size(), found) << name;
  }
}

TEST(TestsApart, AreNoneWhereTestsScatterAlike) {
  EXPECT_LE(named(1).second, 2U);
  EXPECT_LE(named(1, 40).second, 2U);
  EXPECT_EQ(named(1.2).first, 0U) << "less than a factor of 1.5";
}

// Of gains with tails (Student's t with 4 degrees of freedom) and of a law that is no product.
TEST(TestsApart, AreFewWhereTailsAreLongOrTheLawIsAnother) {
  std::size_t apart = 0;
  for (std::size_t seed = 1; seed <= campaigns; ++seed) {
    twin::TwinOptions options;
    options.seed = seed;
    options.noise = seed % 2 ? "normal" : "t4";
    options.law = seed % 3 ? "wanheim_bay" : "log_coulomb";
    options.design =
        twin::parse_design("points=20;validation=1", twin::default_design(twin::twin_set("D")));
    apart += find_tests_apart(twin::make_twin(options).training.data).size();
  }
  EXPECT_LE(apart, 2U);
}

TEST(TestsApart, AreNotAskedOfFewerThanSix) {
  EXPECT_TRUE(find_tests_apart(with_test_at(GainCampaign::spread(5, 1).data(), 3, 0.1)).empty());
}

} // namespace
} // namespace frictab::tests_apart_test
