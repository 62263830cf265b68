// What the design ties to a state, and what it crosses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/fit_law.h"
#include "core/text.h"
#include "data/recordings.h"
#include "stats/blocks.h"
#include "support/gain_campaign.h"
#include "support/trace_text.h"
#include "trace/columns/aliases.h"
#include "trace/columns/candidates.h"
#include "trace/trace_file.h"

namespace frictab::aliases_test {

using data::Dataset;
using test::add_setting;
using test::GainCampaign;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

namespace {

// 16 tests, 8 at 800 and 8 at 1500 MPa.
Dataset two_pressures(std::uint64_t seed = 1) {
  GainCampaign c = GainCampaign::spread(16, seed);
  for (std::size_t e = 0; e < 16; ++e)
    c.pressure[e] = e % 2 ? 1500 : 800;
  return c.data();
}

std::vector<double> per_test(const std::function<double(std::size_t)>& value) {
  std::vector<double> values;
  for (std::size_t e = 0; e < 16; ++e)
    values.push_back(value(e));
  return values;
}

models::Model law(const Dataset& data, const char* name = "wzl") {
  return calibrate::fit_law(*models::find_law(name), {.shear_limit = data.has("sigma_f_MPa")}, data,
                            {})
      .model;
}

std::vector<trace::Alias> aliases(const Dataset& data, const trace::TraceOptions& options = {}) {
  return trace::find_aliases(data, law(data), options);
}

TEST(Aliases, ALabelAtOnePressureEachCannotBeToldFromIt) {
  Dataset data = two_pressures();
  add_setting(data, "batch", per_test([](std::size_t e) { return double(e % 2); }), {"A", "B"});
  const auto found = aliases(data);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].column, "batch");
  EXPECT_EQ(found[0].state, "sigma_n_MPa");
  EXPECT_GT(found[0].share, 0.99);
  EXPECT_EQ(found[0].text,
            "batch cannot be distinguished from sigma_n_MPa: A only at 800, B only at 1500; "
            "one test of A at 1500 would");
  trace::TraceOptions ignored;
  ignored.ignore = {"batch"};
  EXPECT_THAT(aliases(data, ignored), IsEmpty());
  data.columns.back().role = data::Role::channel;
  EXPECT_THAT(aliases(data), IsEmpty()) << "no setting";
}

GainCampaign two_speeds() {
  GainCampaign c = GainCampaign::spread(16, 4);
  for (std::size_t e = 0; e < 16; ++e)
    c.speed[e] = e % 2 ? 80 : 10;
  return c;
}

TEST(Aliases, OfAStateThatTheLawDoesNotFollowAreColumnsThatSetIt) {
  Dataset data = two_speeds().data();
  add_setting(data, "operator", per_test([](std::size_t e) { return double(e % 2); }),
              {"Kim", "Lee"});
  add_setting(data, "nearly", per_test([](std::size_t e) { return double(e % 2 || e == 2); }),
              {"A", "B"});
  const auto found = trace::find_aliases(data, law(data, "coulomb"), {});
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].text, "operator cannot be distinguished from v_rel_mm_s: Kim only at 10, Lee "
                           "only at 80; one test of Kim at 80 would");
}

trace::Candidates candidates(const Dataset& data) {
  const std::vector<double> predicted(data.rows(), 50);
  return trace::find_candidates(data, data, stats::make_blocks(data), predicted, {"sigma_n_MPa"},
                                {});
}

TEST(Candidates, AreTheStateAndNotTheTextThatIsTheSame) {
  Dataset data = two_speeds().data();
  add_setting(data, "operator", per_test([](std::size_t e) { return double(e % 2); }),
              {"Kim", "Lee"});
  std::ranges::rotate(data.columns, data.columns.end() - 1); // before the states
  const trace::Candidates found = candidates(data);
  EXPECT_TRUE(contains(found.columns, "v_rel_mm_s", &trace::CandidateColumn::name));
  EXPECT_FALSE(contains(found.columns, "operator", &trace::CandidateColumn::name));
  EXPECT_THAT(found.notes, testing::Contains("operator is the same as v_rel_mm_s in these data"));
}

TEST(Candidates, AreNoTimesOfTheDay) {
  for (const double start : {0.0, 33300.0}) {
    Dataset data = two_speeds().data();
    data::Column time{"time_s", "s", {}, {}};
    for (std::size_t i = 0; i < data.rows(); ++i)
      time.values.push_back(start + double(i));
    data.columns.push_back(time);
    const trace::Candidates found = candidates(data);
    EXPECT_EQ(contains(found.columns, "time_s", &trace::CandidateColumn::name), start == 0);
    EXPECT_TRUE(contains(found.columns, "time_since_start", &trace::CandidateColumn::name));
  }
}

// Load steps: 50, 100 and 200 N by their number in each recording.
TEST(Candidates, AreNoNumbersOfIntervalsThatAStateGoesWith) {
  GainCampaign steps = GainCampaign::spread(15, 5), random = steps;
  for (std::size_t e = 0; e < 15; ++e)
    steps.pressure[e] = (500 + 30 * double(e / 3)) * std::pow(2, double(e % 3));
  for (const bool stepped : {true, false}) {
    Dataset data = (stepped ? steps : random).data();
    std::vector<double> interval;
    data.recording.clear();
    for (std::size_t e = 0; e < 15; ++e) {
      data.recording.push_back(e / 3);
      interval.push_back(double(e % 3) + 1);
    }
    add_setting(data, data::interval_column, interval);
    const trace::Candidates found = candidates(data);
    EXPECT_NE(contains(found.columns, "interval", &trace::CandidateColumn::name), stepped);
    if (stepped) {
      EXPECT_THAT(found.notes,
                  testing::Contains("interval, which goes with sigma_n_MPa: not searched"));
    }
  }
}

TEST(Aliases, OfTheRecordingAreTextsOfWhichEachLevelHasOne) {
  Dataset data = GainCampaign::spread(16, 6).data();
  data.recording.clear();
  for (std::size_t e = 0; e < 16; ++e)
    data.recording.push_back(e / 4);
  add_setting(data, "oil", per_test([](std::size_t e) { return double(e / 4); }),
              {"A", "B", "C", "D"});
  add_setting(data, "shift", per_test([](std::size_t e) { return double(e / 2 % 2); }),
              {"early", "late"}); // both in each
  const auto found = aliases(data);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].text, HasSubstr("oil cannot be distinguished from the recording"));
}

TEST(Aliases, NumbersAreToldAsLevelsOrAsALine) {
  Dataset data = two_pressures();
  add_setting(data, "coat_um", per_test([](std::size_t e) { return e % 2 ? 7.5 : 5.0; }));
  EXPECT_THAT(aliases(data)[0].text, HasSubstr("5 only at 800, 7.5 only at 1500; one test of 5"));
  GainCampaign c = GainCampaign::spread(16, 2);
  Dataset line = c.data();
  add_setting(line, "stroke_speed", per_test([&](std::size_t e) { return 3 * c.speed[e] + 0.1; }));
  const auto found = aliases(line);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_THAT(found[0].text,
              HasSubstr("stroke_speed cannot be distinguished from v_rel_mm_s: they change "
                        "together; one test with stroke_speed "));
}

TEST(Aliases, AreNoneOfWhatIsCrossedOrNamesTestsOrVariesWithin) {
  Dataset data = two_pressures();
  add_setting(data, "crossed", per_test([](std::size_t e) { return double(e / 2 % 2); }),
              {"A", "B"});
  add_setting(data, "specimen", per_test([](std::size_t e) { return double(e); }),
              {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j", "k", "l", "m", "n", "o", "p"});
  data.columns.push_back(data.columns[0]);
  data.columns.back().name = "load_cell_2"; // follows the pressure, row by row
  EXPECT_THAT(aliases(data), IsEmpty());
}

TEST(Aliases, AskForNoTestOnAnotherDateNorForASourceOfTheState) {
  Dataset data = two_pressures();
  add_setting(data, "Date", per_test([](std::size_t e) { return double(e % 2); }),
              {"2021-11-09", "2021-11-10"});
  data.columns.back().role = data::Role::order;
  const auto found = aliases(data);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].text, "Date cannot be distinguished from sigma_n_MPa: they change together; "
                           "tests at the sigma_n_MPa of the first ones would");
  data.columns.back().role = data::Role::state; // the pressure is computed from it
  EXPECT_THAT(aliases(data), IsEmpty());
}

TEST(Aliases, AreNoneOfAStateThatIsTheSameInAllTests) {
  GainCampaign c = GainCampaign::spread(16, 3);
  for (std::size_t e = 0; e < 16; ++e) {
    c.pressure[e] = 1000 * (1 + 1e-4 * double(e % 2)); // as a load cell reads one load
    c.speed[e] = 50;
  }
  Dataset data = c.data(); // the temperature rises by 5 degC in a test
  auto& temperature = data.columns[2].values;
  for (std::size_t i = 0; i < temperature.size(); ++i)
    temperature[i] = 40 + 100 * double(i % c.rows) / double(c.rows) + 0.5 * double(i / c.rows % 2);
  add_setting(data, "batch", per_test([](std::size_t e) { return double(e % 2); }), {"A", "B"});
  EXPECT_THAT(trace::find_aliases(data, law(data, "exp_coulomb"), {}), IsEmpty());
}

TEST(Aliases, AreNoneByChance) {
  std::size_t found = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    Dataset data = GainCampaign::spread(16, seed).data();
    Random random(seed, 99);
    add_setting(data, "coating",
                per_test([&](std::size_t) { return double(random.uniform() < 0.5); }), {"A", "B"});
    add_setting(data, "rig",
                per_test([&](std::size_t) { return std::floor(4 * random.uniform()); }));
    add_setting(data, "roughness", per_test([&](std::size_t) { return random.uniform(); }));
    found += aliases(data).size();
  }
  EXPECT_EQ(found, 0U);
}

// Materials differ in their flow stress: that is no alias where the law takes it for its limit.
TEST(Aliases, AreNotAskedOfAStateThatOnlyLimits) {
  Dataset data = two_pressures();
  add_setting(data, "sigma_f_MPa",
              per_test([](std::size_t e) { return e / 2 % 2 ? 480.0 : 620.0; }));
  add_setting(data, "material", per_test([](std::size_t e) { return double(e / 2 % 2); }),
              {"A", "B"});
  EXPECT_THAT(trace::find_aliases(data, law(data, "wzl"), {}), IsEmpty());
  const auto shear = trace::find_aliases(data, law(data, "shear"), {});
  ASSERT_THAT(shear, SizeIs(1));
  EXPECT_EQ(shear[0].state, "sigma_f_MPa");
}

TEST(Aliases, StandBesideNothingWasFound) {
  Dataset data = two_pressures();
  add_setting(data, "batch", per_test([](std::size_t e) { return double(e % 2); }), {"A", "B"});
  const calibrate::ModelFit fit =
      calibrate::fit_law(*models::find_law("wzl"), {.shear_limit = false}, data, {});
  trace::Trace t;
  t.model = "wzl";
  t.cannot_tell = trace::find_aliases(data, fit.model, {});
  EXPECT_THAT(test::trace_text(t, words::Detail::brief),
              HasSubstr("\n  batch cannot be distinguished from sigma_n_MPa: A"));
  EXPECT_THAT(
      words::trace_in_short(t),
      HasSubstr("wzl: no missing effect found; batch cannot be distinguished from sigma_n_MPa"));
}

} // namespace
} // namespace frictab::aliases_test
