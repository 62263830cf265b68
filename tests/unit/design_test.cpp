// The tests that a trace advises to run next: they can be run, and they settle what they are for.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration.h"
#include "core/random.h"
#include "support/trace_text.h"
#include "trace/advise/candidate_tests.h"
#include "trace/trace.h"

namespace frictab::design_test {

using data::Dataset;
using test::trace_text;
using trace::settings_of;

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct TestRun {
  double pressure = 100, speed = 10, temperature = 20;
  std::vector<std::pair<std::string, double>> set; // further columns
};

constexpr std::size_t rows = 40;

// Plain numbers, no twin: pressure swells along a test.
Dataset campaign_of(const std::vector<TestRun>& tests) {
  Dataset data;
  for (const char* name : {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "T_tool_C", "s_mm",
                           "time_s", "tau_R_MPa"})
    data.columns.push_back({name, "", {}, {}});
  for (const auto& [name, value] : tests.front().set)
    data.columns.push_back({name, "", {}, {}});
  for (std::size_t e = 0; e < tests.size(); ++e) {
    const TestRun& test = tests[e];
    for (std::size_t i = 0; i < rows; ++i) {
      const double part = static_cast<double>(i) / (rows - 1);
      const double values[] = {test.pressure * (0.8 + 0.4 * part),
                               1 + part,
                               test.speed,
                               test.temperature + 30 * part,
                               test.temperature,
                               0.1 * test.speed * part,
                               0.1 * part,
                               1};
      for (std::size_t c = 0; c < std::size(values); ++c)
        data.columns[c].values.push_back(values[c]);
      for (std::size_t c = 0; c < test.set.size(); ++c)
        data.columns[std::size(values) + c].values.push_back(test.set[c].second);
    }
    data.experiments.push_back(fmt::format("T{:02}", e));
    data.first_row.push_back((e + 1) * rows);
  }
  return data;
}

std::vector<TestRun> three_tests() {
  return {{100, 10, 20, {{"film_um", 1}}},
          {200, 20, 60, {{"film_um", 2}}},
          {300, 40, 100, {{"film_um", 4}}}};
}

TEST(CandidateTests, SettingsAreTheCampaignsRangeWidenedByATenth) {
  const Dataset data = campaign_of(three_tests());
  const auto settings = settings_of(data, {"film_um", "sigma_n_MPa", "T_tool_C"});
  ASSERT_EQ(settings.size(), 3u);
  EXPECT_THAT(settings[0].text, ElementsAre("0.7", "2.5", "4.3"));
  EXPECT_THAT(settings[1].text, ElementsAre("80", "200", "320"));
  EXPECT_THAT(settings[2].text, ElementsAre("12", "60", "108"));
}

TEST(CandidateTests, NumbersThatTestsShareAreSetToTheseAndNothingBelowZero) {
  std::vector<TestRun> tests;
  for (int e = 0; e < 8; ++e)
    tests.push_back(
        {100.0 + 10 * e,
         10,
         20,
         {{"coated", e % 2 == 0 ? 0.0 : 1.0}, {"dose_pct", 0.5 * e}, {"run_order", 1.0 + e}}});
  const auto settings = settings_of(campaign_of(tests), {"coated", "dose_pct", "run_order"});
  ASSERT_EQ(settings.size(), 2u) << "nobody sets the order of tests";
  EXPECT_THAT(settings[0].text, ElementsAre("0", "1"));
  EXPECT_THAT(settings[1].text, ElementsAre("0", "1.93", "3.85"));
}

TEST(CandidateTests, NoDateAndNoRunningNumberIsSet) {
  std::vector<TestRun> tests;
  for (int e = 0; e < 8; ++e)
    tests.push_back({100.0 + 10 * e, 10, 20, {{"Date", e / 4}, {"lfd", 1.0 + e}, {"interval", e}}});
  Dataset data = campaign_of(tests);
  for (data::Column& column : data.columns) {
    if (column.name == "Date") column.levels = {"2021-11-09", "2021-11-10"};
    if (column.name == "Date" || column.name == "lfd") column.role = data::Role::order;
  }
  EXPECT_THAT(settings_of(data, {"Date", "lfd", "interval"}), IsEmpty());
  for (data::Column& column : data.columns)
    if (column.name == "lfd") column.role = data::Role::setting;
  EXPECT_EQ(settings_of(data, {"lfd"}).size(), 1u);
}

TEST(CandidateTests, WhatFollowsFromOthersIsSetThroughThem) {
  const Dataset data = campaign_of(three_tests());
  const auto names = [&](const char* column) {
    std::vector<std::string> found;
    for (const trace::Setting& setting : settings_of(data, {column}))
      found.push_back(setting.column);
    return found;
  };
  EXPECT_THAT(names("s_mm"), ElementsAre("v_rel_mm_s", "sigma_n_MPa"));
  EXPECT_THAT(names("psi"), ElementsAre("v_rel_mm_s", "sigma_n_MPa"));
  EXPECT_THAT(names("T_contact_C"), ElementsAre("T_tool_C", "v_rel_mm_s"));
}

TEST(CandidateTests, WhatNeverDifferedCannotBeSet) {
  std::vector<TestRun> tests = three_tests();
  for (TestRun& test : tests)
    test.speed = 10;
  EXPECT_THAT(settings_of(campaign_of(tests), {"v_rel_mm_s"}), IsEmpty());
}

TEST(CandidateTests, StatesKeepTheirShapeAndWhatDependsOnThemFollows) {
  const Dataset data = campaign_of(three_tests());
  const trace::CandidateTests made =
      trace::candidate_tests(data, settings_of(data, {"v_rel_mm_s", "sigma_n_MPa", "T_tool_C"}));
  EXPECT_EQ(made.like, "T01") << "the one in the middle";
  EXPECT_EQ(made.data.experiments.size(), 27u);
  for (std::size_t e = 0; e < made.at.size(); ++e) {
    const std::size_t first = made.data.first_row[e], last = made.data.first_row[e + 1] - 1;
    const auto at = [&](const char* name, std::size_t row) { return made.data.values(name)[row]; };
    EXPECT_NEAR(at("v_rel_mm_s", first), made.settings[0].values[made.at[e][0]], 1e-9);
    EXPECT_NEAR(at("s_mm", last), 2, 1e-12) << "the same way";
    EXPECT_NEAR(at("time_s", last) * at("v_rel_mm_s", last), 2, 1e-9) << "in another time";
    EXPECT_NEAR(at("sigma_n_MPa", last) / at("sigma_n_MPa", first), 1.5, 1e-9);
    EXPECT_NEAR(at("T_contact_C", last) - at("T_tool_C", last), 30, 1e-9);
  }
}

// --- what is advised
// ------------------------------------------------------------------------------

trace::Trace traced(const Dataset& training, const Dataset& validation) {
  calibrate::ModelOptions models;
  models.use = {"coulomb"};
  models.shear_limit = false;
  calibrate::CalibrationOptions calibration;
  calibration.bootstrap = 100;
  const calibrate::Calibration calibrated =
      calibrate::calibrate({training, validation, models, calibration});
  return trace::trace({training, validation, calibrated.fits.front(), {}, 100, 1});
}

// Friction follows the film; the humidity went with it in all tests but for a little.
Dataset confounded(std::size_t count, std::uint64_t seed) {
  std::vector<TestRun> tests;
  std::vector<double> gain;
  for (std::size_t e = 0; e < count; ++e) {
    Random random(seed, e);
    const double film = 1 + 3 * random.uniform();
    tests.push_back(
        {100 + 200 * random.uniform(),
         10 + 30 * random.uniform(),
         20,
         {{"film_um", film}, {"humidity_pct", 30 + 10 * (film + 0.04 * random.normal())}}});
    gain.push_back((1 + 0.1 * (film - 2.5)) * (1 + 0.03 * random.normal()));
  }
  Dataset data = campaign_of(tests);
  for (std::size_t e = 0; e < count; ++e) {
    Random random(seed + 1, e);
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      data.columns[7].values[i] =
          0.1 * gain[e] * data.columns[0].values[i] * (1 + 0.01 * random.normal());
  }
  return data;
}

TEST(Design, TwoColumnsThatWentTogetherAreSetAgainstEachOther) {
  const trace::Trace t = traced(confounded(24, 3), confounded(12, 77));
  ASSERT_EQ(t.effects.size(), 1u) << trace_text(t);
  const trace::Design& design = t.effects.front().design;
  ASSERT_GE(design.tests.size(), 3u) << trace_text(t);
  EXPECT_LE(design.tests.size(), 6u);
  EXPECT_GT(design.probability, 0.8);
  EXPECT_THAT(design.settles, testing::UnorderedElementsAre("film_um", "humidity_pct"));
  ASSERT_EQ(design.columns.size(), 2u);
  std::set<std::string> seen;
  for (const std::vector<std::string>& test : design.tests) {
    const double a = std::stod(test[0]), b = std::stod(test[1]);
    const bool film_first = design.columns[0] == "film_um";
    const double film = film_first ? a : b, humidity = film_first ? b : a;
    EXPECT_NE(film > 2.5, humidity > 55) << "one high where the other is low";
    EXPECT_GE(film, 0.5);
    EXPECT_LE(film, 4.5);
  }
  EXPECT_THAT(trace_text(t), HasSubstr("would distinguish them with a probability of"));
}

// 25 % of mu per e-fold is far too much for rock; what counts is that it is read off.
TEST(Design, AVelocityStepIsALeadWithItsChangePerEFold) {
  const double a_minus_b = 0.004;
  std::vector<TestRun> tests(2);
  tests[1].pressure = 150;
  Dataset data = campaign_of(tests);
  for (std::size_t e = 0; e < 2; ++e) {
    Random random(5, e);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::size_t row = data.first_row[e] + i;
      const double speed = (i / 8) % 2 == 0 ? 0.001 : 0.01;
      data.columns[2].values[row] = speed;
      data.columns[7].values[row] = data.columns[0].values[row] *
                                    (0.6 + a_minus_b * std::log(speed / 0.001)) *
                                    (1 + 0.0005 * random.normal());
    }
  }
  const trace::Trace t = traced(data, data);
  EXPECT_TRUE(t.effects.empty()) << "two tests prove nothing";
  const auto speed = std::find_if(t.leads.begin(), t.leads.end(), [](const trace::Lead& lead) {
    return lead.columns == std::vector<std::string>{"v_rel_mm_s"};
  });
  ASSERT_NE(speed, t.leads.end()) << trace_text(t);
  EXPECT_THAT(speed->why, HasSubstr("mu changes by +0.004 per e-fold of speed"));
}

} // namespace
} // namespace frictab::design_test
