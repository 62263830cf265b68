// What is too large or too small to be measured, units that nobody gave, and tests in other units
// than the others: each made once in campaigns of several kinds of rigs, and campaigns without any.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "data/plausibility.h"
#include "data/scale.h"
#include "twin/twin.h"

namespace frictab::scale_test {

using data::Dataset;
using data::Implausible;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

// ---- rigs ----

struct Rig {
  const char* name;
  std::vector<double> pressures_MPa, speeds_mm_s, starts_C;
  double mu, flow_MPa, lasts_s; // flow stress 0: not known
};

// Designs as they are: one level, two, decades, a furnace; all honest.
const std::vector<Rig>& rigs() {
  static const std::vector<Rig> all = {
      {"cold forging", {600, 1000, 1800}, {5, 50, 200}, {20, 80, 150}, 0.08, 420, 10},
      {"strip drawing", {80}, {10, 100, 1000}, {20}, 0.12, 0, 3},
      {"pin on disc", {0.5, 1, 2}, {50, 100, 500}, {22}, 0.45, 0, 3600},
      {"pin on disc, nominal flow stress", {0.5, 1, 2}, {50, 100}, {22}, 0.45, 480, 3600},
      {"furnace", {20, 50}, {100}, {20, 300}, 0.4, 0, 600},
      {"furnace of levels", {20}, {100}, {20, 100, 200, 300}, 0.4, 0, 600},
      {"traction machine", {800, 1000, 1250}, {10, 100, 1000, 4000}, {40, 90}, 0.05, 0, 120},
      {"two loads, ten times", {10, 100}, {20}, {25}, 0.2, 0, 60},
      {"loads over decades", {0.1, 1, 10, 100, 1000}, {20}, {25}, 0.2, 0, 60},
      {"rock", {5}, {1e-6, 1e-5, 1e-4, 1e-3}, {23}, 0.6, 0, 20000},
      {"shear cell", {0.002, 0.004, 0.009}, {0.02}, {21}, 0.5, 0, 300},
      {"lead screw", {3, 6}, {2, 20}, {25}, 0.1, 0, 30},
      {"hot forging", {100, 200, 300}, {100, 300}, {900, 1100}, 0.3, 90, 2},
      {"fretting", {50, 100}, {0.5, 5}, {25}, 0.7, 0, 5000}};
  return all;
}

void add(Dataset& data, const char* name, const char* unit) {
  data.columns.push_back({name, unit, std::vector<double>(data.rows()), {}, {}, {}});
}

std::vector<double>& values(Dataset& data, const std::string& name) {
  for (data::Column& column : data.columns)
    if (column.name == name) return column.values;
  throw std::logic_error(name);
}

double among(const std::vector<double>& levels, Random& random) {
  return levels[std::size_t(random.uniform() * double(levels.size()))];
}

// 12 tests, each in a file of its own, with settings drawn from the rig's levels.
Dataset campaign(const Rig& rig, std::uint64_t seed, std::size_t tests = 12) {
  constexpr std::size_t rows = 30;
  Random random(seed, 0x7363616c65);
  Dataset data;
  for (std::size_t e = 0; e < tests; ++e) {
    data.experiments.push_back(fmt::format("T{}", e + 1));
    data.file_of.push_back(fmt::format("T{}.csv", e + 1));
    data.first_row.push_back(rows * (e + 1));
  }
  for (const auto& [name, unit] : {std::pair("time_s", "s"),
                                   {"sigma_n_MPa", "MPa"},
                                   {"v_rel_mm_s", "mm/s"},
                                   {"T_contact_C", "degC"},
                                   {"s_mm", "mm"},
                                   {"tau_R_MPa", "MPa"},
                                   {"F_N_N", "N"},
                                   {"F_R_N", "N"}})
    add(data, name, unit);
  if (rig.flow_MPa > 0) add(data, "sigma_f_MPa", "MPa");
  for (std::size_t e = 0; e < tests; ++e) {
    const double pressure = among(rig.pressures_MPa, random),
                 speed = among(rig.speeds_mm_s, random), start = among(rig.starts_C, random),
                 gain =
                     std::exp(0.05 * random.normal()) * std::pow(speed / rig.speeds_mm_s[0], -0.05);
    for (std::size_t i = 0; i < rows; ++i) {
      const std::size_t row = data.first_row[e] + i;
      const double part = double(i) / (rows - 1);
      const double p = pressure * (1 + 0.01 * random.normal());
      const double tau = rig.mu * gain * p * (1 + 0.03 * random.normal());
      values(data, "time_s")[row] = part * rig.lasts_s;
      values(data, "sigma_n_MPa")[row] = p;
      values(data, "v_rel_mm_s")[row] = speed;
      values(data, "T_contact_C")[row] = start + 15 * part + 0.5 * random.normal();
      values(data, "s_mm")[row] = part * rig.lasts_s * speed;
      values(data, "tau_R_MPa")[row] = tau;
      values(data, "F_N_N")[row] = 78.5 * p;
      values(data, "F_R_N")[row] = 78.5 * tau;
      if (rig.flow_MPa > 0) values(data, "sigma_f_MPa")[row] = rig.flow_MPa * (1 + 0.2 * part);
    }
  }
  return data;
}

Implausible mixed(const Dataset& data) {
  const Dataset* const one = &data;
  return data::mixed_units({&one, 1});
}

void change(Dataset& data, const std::string& name, std::size_t from, std::size_t to,
            const std::function<double(double)>& how) {
  for (std::size_t i = data.first_row[from]; i < data.first_row[to]; ++i)
    values(data, name)[i] = how(values(data, name)[i]);
}

void scale(Dataset& data, const std::string& name, double factor) {
  change(data, name, 0, data.experiments.size(), [&](double x) { return factor * x; });
}

// What the checks of scale find, by name.
std::map<std::string, Implausible> found_in(const Dataset& data) {
  std::map<std::string, Implausible> out;
  for (Implausible& one : data::find_implausible(data))
    for (const char* name : {"sliding_speed", "temperature", "elapsed_time", "sliding_path",
                             "flow_stress", "mixed_units"})
      if (one.check == name) out.emplace(name, one);
  return out;
}

// ---- nothing is wrong ----

TEST(Scale, SaysNothingOfHonestCampaignsOfAllRigs) {
  for (const Rig& rig : rigs())
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
      for (const std::size_t tests : {6, 12, 30})
        for (const auto& [name, one] : found_in(campaign(rig, seed, tests)))
          if (name != "flow_stress" || rig.pressures_MPa[0] > 1) // that one is told
            ADD_FAILURE() << rig.name << " " << seed << " " << name << ": " << one.what;
}

TEST(SlowScale, SaysNothingOfTwoHundredTwins) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    for (const char* profile : {"constant", "varied"})
      for (const char* noise : {"t4", "heteroscedastic"}) {
        twin::TwinOptions options;
        options.seed = seed;
        options.profile = profile;
        options.noise = noise;
        options.design = twin::parse_design(fmt::format("points=60;validation=1"),
                                            twin::default_design(twin::twin_set("D")));
        for (const auto& [name, one] : found_in(twin::make_twin(options).training.data))
          ADD_FAILURE() << seed << " " << profile << " " << noise << " " << name << ": "
                        << one.what;
      }
}

// ---- limits ----

TEST(Scale, NamesASpeedThatNothingSlidesAt) {
  Dataset data = campaign(rigs()[0], 1);
  scale(data, "v_rel_mm_s", 86400);
  const auto found = found_in(data);
  ASSERT_EQ(found.count("sliding_speed"), 1U);
  EXPECT_TRUE(found.at("sliding_speed").most());
  EXPECT_THAT(found.at("sliding_speed").what, HasSubstr("above 200,000 mm/s"));
  EXPECT_THAT(found.at("sliding_speed").hint, HasSubstr("days"));
}

TEST(Scale, NamesTemperaturesOutsideWhatRigsBearAndKelvin) {
  for (const auto& [by, words] : {std::pair(-273.15, "outside -200 to 1500"),
                                  {1600.0, "outside -200 to 1500"},
                                  {273.15, "never below 270"}}) {
    Dataset data = campaign(rigs()[2], 1);
    change(data, "T_contact_C", 0, 12, [&, by = by](double T) { return T + by; });
    ASSERT_EQ(found_in(data).count("temperature"), 1U) << by;
    EXPECT_THAT(found_in(data).at("temperature").what, HasSubstr(words));
    EXPECT_TRUE(found_in(data).at("temperature").most());
  }
}

TEST(Scale, NamesClocksThatRunTooFastOrTooSlow) {
  for (const auto& [factor, words, is_error] :
       {std::tuple(1e7, "ms or us", true), {1e-10, "days", true}, {1 / 86400.0, "days", false}}) {
    Dataset data = campaign(rigs()[0], 1);
    scale(data, "time_s", factor);
    const auto found = found_in(data);
    ASSERT_EQ(found.count("elapsed_time"), 1U) << factor;
    EXPECT_THAT(found.at("elapsed_time").hint, HasSubstr(words));
    EXPECT_EQ(found.at("elapsed_time").most(), is_error) << factor;
  }
}

TEST(Scale, NamesAPathAroundTheEarth) {
  Dataset data = campaign(rigs()[2], 1);
  scale(data, "s_mm", 1e6);
  ASSERT_EQ(found_in(data).count("sliding_path"), 1U);
}

// Far below the flow stress: an error where nobody gave the unit, told where somebody did.
TEST(Scale, ComparesNormalStressesWithTheFlowStress) {
  Dataset data = campaign(rigs()[0], 1);
  scale(data, "sigma_n_MPa", 1e-3);
  EXPECT_FALSE(found_in(data).at("flow_stress").most());
  data.assumed = {{"sigma_n_MPa", "Normalkraft", "N", ""}};
  const Implausible found = found_in(data).at("flow_stress");
  EXPECT_TRUE(found.most());
  EXPECT_THAT(found.what, HasSubstr("sigma_n_MPa is 0.598 to 1.81 at a flow stress"));
  EXPECT_THAT(found.hint, AllOf(HasSubstr("'Normalkraft'"), HasSubstr("in kN 598 to 1,810")));
  Dataset above = campaign(rigs()[0], 1);
  scale(above, "sigma_f_MPa", 1e-3);
  EXPECT_TRUE(found_in(above).at("flow_stress").most());
}

// ---- units that nobody gave ----

std::vector<std::string> questions(Dataset data, const std::vector<data::AssumedUnit>& assumed) {
  data.assumed = assumed;
  data::ask_for_units(data);
  return data.unit_questions;
}

TEST(Scale, AsksWhereSeveralUnitsAreUsual) {
  EXPECT_THAT(
      questions(campaign(rigs()[2], 1), {{"sigma_n_MPa", "p", "MPa", ""}}),
      testing::ElementsAre(
          AllOf(HasSubstr("no unit is given for 'p', taken as MPa: sigma_n_MPa is 0.498 to 2.01; "),
                HasSubstr("in GPa 498 to 2,010"), HasSubstr("unit = \"MPa\""))));
}

TEST(Scale, AsksFirstForWhatIsUsualInAnotherUnitOnly) {
  Dataset data = campaign(rigs()[0], 1);
  scale(data, "sigma_n_MPa", 1e-3);
  for (const char* name : {"v_rel_mm_s"})
    scale(data, name, 1);
  const auto asked = questions(data, {{"s_mm", "Weg", "mm", ""},
                                      {"v_rel_mm_s", "v", "mm/s", ""},
                                      {"sigma_n_MPa", "Normalkraft", "N", ""}});
  ASSERT_GE(asked.size(), 2U);
  EXPECT_THAT(asked.front(), AllOf(HasSubstr("'Normalkraft', taken as N"),
                                   HasSubstr("which is hardly so"), HasSubstr("in kN")));
}

TEST(Scale, AsksForAUnitThatTheNameEndsWith) {
  EXPECT_THAT(questions(campaign(rigs()[2], 1), {{"F_N_N", "Force_kN", "N", "kN"}}),
              testing::ElementsAre(HasSubstr("(its name ends with kN)")));
}

TEST(Scale, DoesNotAskWhereAnotherUnitWouldBeOdd) {
  Dataset data = campaign(rigs()[2], 1);
  EXPECT_THAT(questions(data, {{"T_contact_C", "Temp", "degC", ""}}), IsEmpty());
  EXPECT_THAT(questions(data, {{"F_N_N", "Load", "N", ""}, {"F_R_N", "FF", "N", ""}}), IsEmpty())
      << "the coefficient is the same in any unit";
  EXPECT_THAT(questions(data, {{"F_N_N", "Load", "N", ""}}), IsEmpty())
      << "a usual coefficient with the friction force in N";
  EXPECT_THAT(questions(data, {{"s_mm", "Weg", "mm", ""}}), IsEmpty())
      << "speed and time give the same path";
  data.assumed = {{"T_contact_C", "Temp", "degC", ""}};
  data::ask_for_units(data);
  EXPECT_THAT(data.notes, testing::ElementsAre("no unit is given for Temp (degC): taken so"));
}

TEST(Scale, ReadsAUnitAtTheEndOfAName) {
  EXPECT_EQ(data::unit_in_name("Force_kN", "N"), "kN");
  EXPECT_EQ(data::unit_in_name("load_N", "N"), "N");
  EXPECT_EQ(data::unit_in_name("F_N", "N"), "") << "the normal force";
  EXPECT_EQ(data::unit_in_name("v_mm_s", "mm/s"), "mm/s");
  EXPECT_EQ(data::unit_in_name("sigma_N", "MPa"), "");
  EXPECT_EQ(data::unit_in_name("Normalkraft", "N"), "");
  EXPECT_EQ(data::unit_in_name("T_C", "degC"), "C");
}

// ---- other units than the others' ----

struct Mistake {
  const char* what;
  std::map<std::string, double> factors; // of quantities, in one file; T: 273.15 is added
  const char* unit;
  bool certain;
};
const std::vector<Mistake>& mistakes() {
  static const std::vector<Mistake> all = {
      {"Pa", {{"sigma_n_MPa", 1e6}, {"tau_R_MPa", 1e6}}, "Pa", true},
      {"kPa", {{"sigma_n_MPa", 1e3}, {"tau_R_MPa", 1e3}}, "kPa", true},
      {"GPa", {{"sigma_n_MPa", 1e-3}}, "GPa", true},
      {"kN", {{"F_N_N", 1e-3}, {"F_R_N", 1e-3}}, "kN", true},
      {"kN, and its stress",
       {{"F_N_N", 1e-3}, {"F_R_N", 1e-3}, {"sigma_n_MPa", 1e-3}, {"tau_R_MPa", 1e-3}},
       "kN",
       true},
      {"kgf", {{"F_N_N", 1 / 9.80665}, {"F_R_N", 1 / 9.80665}}, "kgf", false},
      {"friction force in kgf", {{"F_R_N", 1 / 9.80665}}, "kgf", false},
      {"lbf", {{"F_N_N", 1 / 4.448222}, {"F_R_N", 1 / 4.448222}}, "lbf", false},
      {"kgf/mm2", {{"sigma_n_MPa", 1 / 9.80665}, {"tau_R_MPa", 1 / 9.80665}}, "kgf/mm2", false},
      {"m/s", {{"v_rel_mm_s", 1e-3}}, "m/s", true},
      {"m/min", {{"v_rel_mm_s", 60 / 1000.0}}, "m/min", false},
      {"ms", {{"time_s", 1e3}}, "ms", true},
      {"m", {{"s_mm", 1e-3}}, "m", true},
      {"kelvin", {{"T_contact_C", 273.15}}, "K", true}};
  return all;
}

void make(Dataset& data, const Mistake& mistake, std::size_t from, std::size_t to) {
  for (const auto& [name, by] : mistake.factors)
    change(data, name, from, to, [&, by = by](double x) { return by == 273.15 ? x + by : by * x; });
}

// A file of twelve, and half of them; the forces are recorded beside the stresses.
TEST(Scale, FindsFilesInOtherUnits) {
  for (const Mistake& mistake : mistakes())
    for (const std::size_t files : {1, 3}) {
      std::size_t hits = 0, of = 0;
      for (const Rig& rig : rigs())
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
          if (mistake.factors.count("T_contact_C") && rig.starts_C.front() > 30) continue; // hot
          Dataset data = campaign(rig, seed);
          make(data, mistake, 4, 4 + files);
          const Implausible found = mixed(data);
          ++of;
          const bool hit = found.rows == 30 * files &&
                           found.what.find("'T5'") != std::string::npos &&
                           found.what.find(mistake.unit) != std::string::npos;
          hits += hit;
          if (hit)
            EXPECT_EQ(*found.certain, mistake.certain) << mistake.what << " " << found.what;
          else
            std::printf("missed: %s %s: %s\n", mistake.what, rig.name, found.what.c_str());
        }
      RecordProperty(fmt::format("{} in {} files", mistake.what, files),
                     fmt::format("{} of {}", hits, of));
      std::printf("%-24s %zu files: %zu of %zu\n", mistake.what, files, hits, of);
      EXPECT_GT(10 * hits, 6 * of) << mistake.what;
    }
}

TEST(Scale, FindsHalfACampaignInPascal) {
  for (const Rig& rig : rigs())
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Dataset data = campaign(rig, seed);
      make(data, mistakes()[0], 6, 12);
      const Implausible found = mixed(data);
      if (rig.pressures_MPa.size() > 4) continue; // decades: nothing is claimed
      EXPECT_TRUE(found.certain.value_or(false)) << rig.name << " " << found.what;
      EXPECT_THAT(found.what, HasSubstr("'T7'"));
    }
}

// Stresses alone in kgf/mm2: by levels that agree to less than a percent.
TEST(Scale, TellsLevelsThatBecomeThoseOfTheOthers) {
  const Rig rig = {"three pressures", {600, 800, 1000}, {50}, {20}, 0.1, 0, 10};
  Dataset data = campaign(rig, 1);
  std::erase_if(data.columns,
                [](const auto& c) { return c.name.starts_with("F_") || c.name == "sigma_f_MPa"; });
  make(data, mistakes()[8], 4, 6);
  const Implausible found = mixed(data);
  EXPECT_THAT(found.what, AllOf(HasSubstr("'T5', 'T6'"), HasSubstr("kgf/mm2")));
  EXPECT_FALSE(found.most());
}

TEST(Scale, ClaimsNothingOfTestsOfAnotherLubricant) {
  Dataset data = campaign(rigs()[0], 1);
  change(data, "tau_R_MPa", 4, 6, [](double x) { return 9.8 * x; });
  std::erase_if(data.columns, [](const auto& c) { return c.name.starts_with("F_"); });
  EXPECT_GT(mixed(data).rows, 0U);
  std::vector<double> level(data.rows());
  for (std::size_t i = data.first_row[4]; i < data.first_row[6]; ++i)
    level[i] = 1;
  data.columns.push_back({"lubricant", "", level, {"dry", "oil"}, {}, {}});
  EXPECT_EQ(mixed(data).rows, 0U);
}

TEST(Scale, ComparesValidationFilesWithTrainingFiles) {
  Dataset training = campaign(rigs()[0], 1), validation = campaign(rigs()[0], 2, 4);
  make(validation, mistakes()[1], 0, 4);
  for (std::string& file : validation.file_of)
    file = "validation/" + file;
  FaultList faults;
  data::check_units_between(training, validation, {}, {}, faults);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_THAT(faults.all().front().what, HasSubstr("sigma_n_MPa in kPa"));
  FaultList allowed;
  data::check_units_between(training, validation, {"mixed_units"}, {}, allowed);
  EXPECT_TRUE(allowed.empty());
}

} // namespace

} // namespace frictab::scale_test
