// Roles of columns on campaigns of an invented pin-on-disc rig: raw channels that are the friction
// once more, consequences of friction, causes, and what a log book has beside them. Synthetic.
#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "data/disguise.h"
#include "data/roles.h"
#include "data/settings.h"
#include "twin/twin.h"

namespace frictab::roles_test {

using data::Column;
using data::Dataset;
using data::Role;
using testing::Contains;
using testing::HasSubstr;

namespace {

// Coefficients that fall with the load, and with a film which is the rig's own cause; a gain of
// each test; noise that remembers a few rows.
class Rig {
public:
  Rig(std::uint64_t seed, std::size_t tests, std::size_t rows) : random_(seed, 7) {
    for (const char* name : {"time_s", "sigma_n_MPa", "v_rel_mm_s", "tau_R_MPa", "film_nm"})
      data.columns.push_back({name, "", {}, {}});
    for (std::size_t t = 0; t < tests; ++t)
      add_test(t, rows);
  }

  // A column of every row: from its test's number and its row's.
  void add(const std::string& name,
           const std::function<double(std::size_t test, std::size_t row)>& value) {
    Column column{name, "", {}, {}};
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
        column.values.push_back(value(e, i));
    data.columns.push_back(std::move(column));
  }

  double at(const char* name, std::size_t row) const { return data.values(name)[row]; }
  double normal() { return random_.normal(); }
  double uniform() { return random_.uniform(); }
  // One draw for each test.
  std::vector<double> of_tests(const std::function<double()>& draw) {
    std::vector<double> values;
    for (std::size_t e = 0; e < data.experiments.size(); ++e)
      values.push_back(draw());
    return values;
  }

  Dataset data;

private:
  void add_test(std::size_t t, std::size_t rows) {
    const double pressure = 20 * std::pow(2.0, double(t % 4)),
                 speed = 5 * std::pow(4.0, double(t % 3));
    const double film = 100 * std::exp(0.3 * random_.normal());
    const double gain = std::exp(0.04 * random_.normal());
    double slow = 0;
    for (std::size_t i = 0; i < rows; ++i) {
      slow = 0.9 * slow + 0.01 * random_.normal();
      const double p = pressure * (1 + 0.02 * random_.normal());
      const double mu = 0.12 * std::pow(p / 50, -0.15) * std::pow(film / 100, -0.2) * gain;
      const double tau = p * mu * std::exp(slow + 0.01 * random_.normal());
      const double row[] = {0.1 * double(i), p, speed, tau, film};
      for (std::size_t c = 0; c < std::size(row); ++c)
        data.columns[c].values.push_back(row[c]);
    }
    data.experiments.push_back("t" + std::to_string(t));
    data.first_row.push_back(data.first_row.back() + rows);
  }

  Random random_;
};

std::map<std::string, data::Disguise> disguises(const Dataset& data) {
  const Dataset* const parts[] = {&data};
  return data::find_disguises(parts, {});
}

bool is_called(const Dataset& data, const std::string& name) {
  const auto found = disguises(data);
  return found.count(name) > 0 && found.at(name).sure;
}

// Readings of the friction, each by another instrument.
struct Reading {
  const char* name;
  std::function<void(Rig&)> add;
};
const Reading readings[] = {
    {"a force",
     [](Rig& rig) { rig.add("x", [&](auto, auto i) { return 20 * rig.at("tau_R_MPa", i); }); }},
    {"a coefficient",
     [](Rig& rig) {
       rig.add("x",
               [&](auto, auto i) { return rig.at("tau_R_MPa", i) / rig.at("sigma_n_MPa", i); });
     }},
    {"a torque over a radius of each test",
     [](Rig& rig) {
       const auto radius = rig.of_tests([&] { return 10 + 10 * rig.uniform(); });
       rig.add("radius", [=](auto e, auto) { return radius[e]; });
       rig.add("x", [&, radius](auto e, auto i) { return rig.at("tau_R_MPa", i) * radius[e]; });
     }},
    {"a second cell with noise and another zero",
     [](Rig& rig) {
       rig.add("x", [&](auto, auto i) {
         return 3 + 1.7 * rig.at("tau_R_MPa", i) * (1 + 0.001 * rig.normal());
       });
     }},
    {"the power of the drive",
     [](Rig& rig) {
       rig.add("x", [&](auto, auto i) { return rig.at("tau_R_MPa", i) * rig.at("v_rel_mm_s", i); });
     }},
    {"a signed force", [](Rig& rig) {
       rig.add("x", [&](auto e, auto i) { return (e % 2 ? -5 : 5) * rig.at("tau_R_MPa", i); });
     }}};

// What follows friction, goes before it, or has nothing to do with it.
void add_company(Rig& rig) {
  double wear = 0;
  const auto humidity = rig.of_tests([&] { return std::round(45 + 8 * rig.normal()); });
  const auto setting = rig.of_tests([&] { return double(rig.uniform() < 0.5); });
  rig.add("humidity", [=](auto e, auto) { return humidity[e]; });
  rig.add("coated", [=](auto e, auto) { return setting[e]; });
  rig.add("vibration",
          [&](auto, auto i) { return rig.at("tau_R_MPa", i) * std::exp(0.2 * rig.normal()); });
  rig.add("sound", [&](auto, auto i) {
    return std::sqrt(rig.at("tau_R_MPa", i) * rig.at("v_rel_mm_s", i)) *
           std::exp(0.1 * rig.normal());
  });
  rig.add("depth", [&](auto, auto i) {
    const bool starts = rig.at("time_s", i) == 0;
    return wear = (starts ? 0 : wear) + 1e-3 * rig.at("tau_R_MPa", i) * (1 + 0.3 * rig.normal());
  });
  rig.add("rise_C", [&](auto, auto i) {
    return 25 + 5 * (1 - std::exp(-rig.at("time_s", i) / 3)) * rig.at("tau_R_MPa", i) / 10 +
           0.2 * rig.normal();
  });
}

Role role_of(const Dataset& data, const std::string& name) {
  return data.find(name)->role;
}

Dataset with_roles(Dataset data, const data::DataOptions& options = {}) {
  FaultList faults;
  Dataset* const parts[] = {&data};
  data::find_roles(parts, options, faults);
  faults.throw_if_any();
  return data;
}

TEST(Roles, AVerdictOnTestsIsNoCauseAndTheTestsItRejectsAreNamed) {
  const auto found = [](const std::string& name, const std::vector<std::string>& levels) {
    Rig rig(3, 8, 20);
    rig.add(name, [](std::size_t test, std::size_t) { return test == 5 ? 0 : 1; });
    rig.data.columns.back().levels = levels;
    Dataset* const parts[] = {&rig.data};
    FaultList faults;
    data::find_roles(parts, {}, faults);
    return rig.data;
  };
  const Dataset flagged = found("valid", {"FALSE", "TRUE"});
  EXPECT_EQ(flagged.find("valid")->role, Role::ignore);
  EXPECT_THAT(flagged.implausible,
              Contains("valid is \"FALSE\" in 't5': judged to be bad, and used; data.drop = { "
                       "valid = [\"FALSE\"] } leaves such rows out"));
  EXPECT_EQ(found("Probe", {"n.i.O.", "i.O."}).find("Probe")->role, Role::ignore);
  EXPECT_THAT(found("comment", {"pin slipped, do not use", ""}).implausible,
              Contains(HasSubstr("in 't5'")));
  for (const auto& [name, levels] :
       {std::pair<std::string, std::vector<std::string>>("lubricated", {"FALSE", "TRUE"}),
        {"surface", {"bad", "good"}},
        {"oil", {"A", "B"}}}) {
    const Dataset cause = found(name, levels);
    EXPECT_EQ(cause.find(name)->role, Role::label) << name;
    EXPECT_TRUE(cause.implausible.empty()) << name;
  }
}

} // namespace

TEST(Roles, AReadingOfTheFrictionIsCalledOne) {
  std::size_t found = 0, of = 0;
  for (const Reading& reading : readings)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Rig rig(seed, 12, 120);
      reading.add(rig);
      const bool called = is_called(rig.data, "x");
      EXPECT_TRUE(called || seed > 1) << reading.name;
      found += called;
      ++of;
    }
  EXPECT_GE(100 * found, 97 * of) << found << " of " << of;
}

TEST(Roles, CausesConsequencesAndLogBooksAreNoReadings) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Rig rig(seed, 10 + seed % 20, seed % 3 == 0 ? 3 : 100);
    add_company(rig);
    for (const auto& [name, disguise] : disguises(rig.data))
      EXPECT_FALSE(disguise.sure) << name << ": " << disguise.how << ", seed " << seed;
  }
}

TEST(Roles, AReadingOfOneRowPerTestIsCalledOne) {
  Rig rig(1, 27, 1);
  rig.add("pull", [&](auto, auto i) { return 0.37 * rig.at("tau_R_MPa", i); });
  rig.add("humidity", [&](auto, auto) { return 45 + 8 * rig.normal(); });
  rig.add("cof", [&](auto, auto i) { // read in five thousandths: tests share its values
    return std::round(200 * rig.at("tau_R_MPa", i) / rig.at("sigma_n_MPa", i)) / 200;
  });
  EXPECT_TRUE(is_called(rig.data, "pull"));
  EXPECT_TRUE(is_called(rig.data, "cof"));
  EXPECT_FALSE(is_called(rig.data, "humidity"));
  EXPECT_FALSE(is_called(rig.data, "film_nm"));
}

// A dose in five steps, and friction in proportion to it: nothing is left beside the dose, but
// tests of one dose differ in friction and not in it. What hardly varies is no reading times the
// dose either.
TEST(Roles, ADoseThatFrictionGoesWithIsNoReading) {
  constexpr double doses[] = {0.3, 0.975, 1.65, 2.325, 3};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rig rig(5000 + seed, 12 + seed, 1);
    const auto dose = rig.of_tests([&] { return doses[std::size_t(5 * rig.uniform())]; });
    rig.add("dose", [&](auto e, auto) { return dose[e]; });
    rig.add("air_hPa", [&](auto, auto) { return std::round(1000 + 10 * rig.normal()); });
    for (Column& column : rig.data.columns)
      if (column.name == "tau_R_MPa")
        for (std::size_t i = 0; i < column.values.size(); ++i)
          column.values[i] *= dose[i];
    EXPECT_FALSE(is_called(rig.data, "dose")) << "seed " << seed;
    EXPECT_FALSE(is_called(rig.data, "air_hPa")) << "seed " << seed;
  }
}

TEST(Roles, TextWhoseNumbersAreTheFrictionIsAReading) {
  Rig rig(1, 20, 1);
  rig.add("noted", [&](auto, auto i) { return double(i); });
  for (std::size_t e = 0; e < 20; ++e)
    rig.data.columns.back().levels.push_back("F = " + std::to_string(100 * rig.at("tau_R_MPa", e)) +
                                             " N");
  EXPECT_TRUE(is_called(rig.data, "noted"));
}

TEST(Roles, TheTwinHasNoReadings) {
  std::size_t columns = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    twin::TwinOptions options;
    options.seed = seed;
    options.more_bystanders = true;
    options.profile = seed % 2 ? "constant" : options.profile;
    options.noise = seed % 3 ? "normal" : options.noise;
    options.design =
        twin::parse_design(seed % 5 ? "points=40;validation=1" : "points=12;validation=1",
                           twin::default_design(twin::twin_set("D")));
    const Dataset data = twin::make_twin(options).training.data;
    columns += data.columns.size();
    for (const auto& [name, disguise] : disguises(data))
      ADD_FAILURE() << name << ": " << disguise.how << ", seed " << seed;
  }
  EXPECT_GT(columns, 400u);
}

TEST(Roles, FollowFromTheJobTheDataAndNamesInThatOrder) {
  Rig rig(3, 12, 60);
  add_company(rig);
  rig.add("torque", [&](auto, auto i) { return 0.3 * rig.at("tau_R_MPa", i); });
  rig.add("rpm", [&](auto, auto i) { return 10 * rig.at("v_rel_mm_s", i); });
  rig.add("Mass loss [mg]", [](auto e, auto) { return 1.0 + double(e * e % 7); });
  rig.add("step_pct", [](auto, auto i) { return double(i / 20 % 3); });
  rig.add("Contact Potential", [](auto, auto i) { return double(i / 20 % 3); });
  data::DataOptions options;
  options.columns["tau_R_MPa"].formula = "torque/0.3";
  options.columns["v_rel_mm_s"].formula = "rpm/10";
  options.roles["vibration"] = {Role::setting, {}};
  const Dataset data = with_roles(rig.data, options);
  EXPECT_EQ(role_of(data, "torque"), Role::response);
  EXPECT_EQ(data.find("torque")->why, "tau_R_MPa is computed from it");
  EXPECT_EQ(role_of(data, "rpm"), Role::state);
  EXPECT_EQ(role_of(data, "vibration"), Role::setting);
  EXPECT_EQ(role_of(data, "sound"), Role::channel);
  EXPECT_EQ(role_of(data, "rise_C"), Role::channel);
  EXPECT_EQ(role_of(data, "humidity"), Role::setting);
  EXPECT_EQ(role_of(data, "film_nm"), Role::setting);
  EXPECT_EQ(role_of(data, "Mass loss [mg]"), Role::outcome);
  EXPECT_EQ(role_of(data, "step_pct"), Role::setting);
  EXPECT_EQ(role_of(data, "Contact Potential"), Role::channel) << "at three values, set by nobody";
  EXPECT_EQ(role_of(data, "time_s"), Role::clock);
  EXPECT_THAT(data.notes, Contains(HasSubstr("torque belongs to the measured friction")));
}

TEST(Roles, WhatAWholeTestShowedIsNoSetting) {
  Rig rig(5, 24, 1);
  const auto levels = [](std::size_t e) { return double(e * e % 7); };
  for (const char* const outcome :
       {"wear [mg]", "Wear volume [mm3]", "Mean COF", "mu_max", "Max. temperature [C]",
        "Punch force [kN]", "Stempelkraft [kN]", "Ra after test [um]", "Scar width L [mm]"})
    rig.add(outcome, [&](auto e, auto) { return 1 + levels(e); });
  for (const char* const setting :
       {"hardness", "Ra [um]", "preheat_temp", "days after coating", "mean roughness"})
    rig.add(setting, [&](auto e, auto) {
      return double(2 + std::string(setting).size()) + levels(e); // no two are the same
    });
  for (const char* const number : {"Replicate", "rep", "Wiederholung"})
    rig.add(number, [](auto e, auto) { return double(1 + e % 3); });
  rig.add("Surface after test", [](auto e, auto) { return double(e % 2); });
  rig.data.columns.back().levels = {"bright", "scored"};
  const Dataset data = with_roles(rig.data);
  for (const data::Column& column : data.columns) {
    const std::string& name = column.name;
    const bool is_number = name == "Replicate" || name == "rep" || name == "Wiederholung";
    const bool is_setting = name == "hardness" || name == "Ra [um]" || name == "preheat_temp" ||
                            name == "days after coating" || name == "mean roughness";
    if (data::find_quantity(name) || name == "film_nm") continue;
    EXPECT_EQ(column.role, is_number    ? Role::ignore
                           : is_setting ? Role::setting
                                        : Role::outcome)
        << name;
  }
}

TEST(Roles, TheSetValueOfAMeasuredStateIsNoCauseOfItsOwn) {
  Rig rig(6, 12, 40);
  const auto pressure = [](std::size_t e) { return 20 * std::pow(2.0, double(e % 4)); };
  rig.add("Load [N]", [&](auto e, auto) { return 20 * pressure(e); });
  rig.add("p_ksi", [&](auto e, auto) { return 0.145 * pressure(e); });
  rig.add("dose_mg", [&](auto e, auto) { return 20 * pressure(e); });
  rig.add("spring [N]", [&](auto e, auto) { return 1 + double(e * e % 7); });
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "Load [N]"), Role::ignore);
  EXPECT_EQ(data.find("Load [N]")->why, "the set sigma_n_MPa, which is measured");
  EXPECT_EQ(role_of(data, "p_ksi"), Role::ignore);
  EXPECT_EQ(role_of(data, "dose_mg"), Role::setting);
  EXPECT_EQ(role_of(data, "spring [N]"), Role::setting);
}

TEST(Roles, ASetValueNeedsNoUnit) {
  Rig rig(6, 12, 40);
  const auto pressure = [](std::size_t e) { return 20 * std::pow(2.0, double(e % 4)); };
  rig.add("name1", [&](auto e, auto) { return 1000 * pressure(e); }); // of a sheet "20000 Pa"
  rig.add("load", [&](auto e, auto) { return 28.27 * pressure(e); });
  rig.add("amount", [&](auto e, auto) { return 28.27 * pressure(e); });
  rig.add("stage", [&](auto e, auto) { return e % 4 < 2 ? 1.0 : 10.0; });
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "name1"), Role::ignore);
  EXPECT_EQ(role_of(data, "load"), Role::ignore);
  EXPECT_EQ(role_of(data, "amount"), Role::setting);
  EXPECT_EQ(role_of(data, "stage"), Role::setting);
}

TEST(Roles, WhatNumbersNamesOrDatesTheTestsIsNoCause) {
  Rig rig(8, 24, 1);
  for (const char* number : {"Nr.", "No", "lfd. Nr.", "Point", "Index"})
    rig.add(number, [](auto e, auto) { return double(1 + e); });
  for (const char* scatter : {"Std.abw. mu", "StDev COF", "Standardabweichung", "Streuung"})
    rig.add(scatter, [](auto e, auto) { return 0.01 * double(1 + e * e % 7); });
  for (const char* date : {"Datum", "Pruefdatum", "Test date", "Zeitstempel"}) {
    rig.add(date, [](auto e, auto) { return double(e / 8); });
    rig.data.columns.back().levels = {"01.03.2026", "02.03.2026", "04.03.2026"};
  }
  rig.add("Test Name", [](auto e, auto) { return double(e / 3); });
  rig.data.columns.back().levels = {"a", "b", "c", "d", "e", "f", "g", "h"};
  const Dataset data = with_roles(rig.data);
  for (const data::Column& column : data.columns) {
    const std::string& name = column.name;
    if (data::find_quantity(name) || name == "film_nm") continue;
    const bool is_date = column.levels.size() == 3;
    EXPECT_EQ(column.role, is_date                                             ? Role::order
                           : name.starts_with("St") || name.starts_with("Std") ? Role::outcome
                                                                               : Role::test)
        << name;
  }
}

TEST(Roles, NumbersOfSpecimensAreNoSettings) {
  Rig rig(9, 24, 5);
  for (const char* name : {"Schraube Nr.", "Pin no", "repeat"})
    rig.add(name, [](auto e, auto) { return double(e * e % 5); });
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "Schraube Nr."), Role::ignore);
  EXPECT_EQ(role_of(data, "Pin no"), Role::ignore);
  EXPECT_EQ(role_of(data, "repeat"), Role::ignore);
}

TEST(Roles, DateInTheNamesOfFilesOrdersTests) {
  Rig rig(9, 24, 5);
  rig.add("date", [](auto e, auto) { return double(e / 8); });
  rig.data.columns.back().levels = {"20260302_0900", "20260303_0900", "20260304_1130"};
  EXPECT_EQ(role_of(with_roles(rig.data), "date"), Role::order);
}

TEST(Roles, AColumnThatRepeatsAnotherIsNoCauseOfItsOwn) {
  Rig rig(9, 24, 5);
  for (const char* name : {"name2", "Coating", "coating again", "other"}) {
    const bool other = std::string(name) == "other";
    rig.add(name, [=](auto e, auto) { return double(other ? e / 2 % 2 : e % 2); });
    rig.data.columns.back().levels = {"DLC", "TiN"};
  }
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "Coating"), Role::label);
  EXPECT_EQ(role_of(data, "other"), Role::label);
  for (const char* repeats : {"name2", "coating again"}) {
    EXPECT_EQ(role_of(data, repeats), Role::ignore);
    EXPECT_EQ(data.find(repeats)->why, "the same as Coating in every test");
  }
}

TEST(Roles, FreeTextIsNoLabel) {
  Rig rig(4, 20, 5);
  const auto text = [&](const char* name, std::vector<std::string> levels, auto of_test) {
    rig.add(name, [&](auto e, auto) { return double(of_test(e)); });
    rig.data.columns.back().levels = std::move(levels);
  };
  text("machine", {"A", "B"}, [](std::size_t e) { return e % 2; });
  text("seen", {"", "noise at the end", "oil spilt"}, [](std::size_t e) {
    return e == 3 ? 1 : e == 8 ? 2 : 0;
  });
  std::vector<std::string> names;
  for (int i = 0; i < 20; ++i)
    names.push_back("p" + std::to_string(100 + i));
  text("piece", names, [](std::size_t e) { return e; });
  text("additive", {"", "MoS2"}, [](std::size_t e) { return e < 4; });
  text("Bemerkung", {"", "gut"}, [](std::size_t e) { return e % 2; });
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "machine"), Role::label);
  EXPECT_EQ(role_of(data, "seen"), Role::ignore);
  EXPECT_EQ(role_of(data, "piece"), Role::ignore);
  EXPECT_EQ(role_of(data, "additive"), Role::label);
  EXPECT_EQ(role_of(data, "Bemerkung"), Role::ignore);
}

TEST(Roles, WhatFrictionIsComputedFromIsAReadingEvenIfAStateIsToo) {
  Rig rig(14, 12, 40);
  rig.add("pull_kN",
          [&](auto, auto i) { return rig.at("sigma_n_MPa", i) + rig.at("tau_R_MPa", i); });
  rig.add("back_kN",
          [&](auto, auto i) { return rig.at("sigma_n_MPa", i) - rig.at("tau_R_MPa", i); });
  rig.add("width_mm", [](auto e, auto) { return 10.0 + double(e % 3); });
  data::DataOptions options;
  options.columns["tau_R_MPa"].formula = "(pull_kN - back_kN)/2*width_mm/width_mm";
  options.columns["sigma_n_MPa"].formula = "(pull_kN + back_kN)/2*width_mm/width_mm";
  const Dataset data = with_roles(rig.data, options);
  for (const char* name : {"pull_kN", "back_kN"}) {
    EXPECT_EQ(role_of(data, name), Role::response) << name;
    EXPECT_EQ(data.find(name)->why, "tau_R_MPa is computed from it");
  }
  EXPECT_EQ(role_of(data, "width_mm"), Role::state) << "a length that was set, no reading";
  options.roles["pull_kN"] = {Role::channel, {}};
  EXPECT_EQ(role_of(with_roles(rig.data, options), "pull_kN"), Role::channel);
}

TEST(Roles, ASetValueMayBeInAnyUnitThatSetsTheState) {
  Rig rig(6, 12, 40);
  const auto pressure = [](std::size_t e) { return 20 * std::pow(2.0, double(e % 4)); };
  const auto speed = [](std::size_t e) { return 5 * std::pow(4.0, double(e % 3)); };
  for (std::size_t i = 0; i < rig.data.rows(); ++i)
    if (i % 40 < 8) rig.data.columns[2].values[i] *= double(i % 40) / 8; // the way up to the speed
  rig.add("Drehzahl [1/min]", [&](auto e, auto) { return 1.9 * speed(e); });
  rig.add("rpm set", [&](auto e, auto) { return 1.9 * speed(e); });
  rig.add("Speed m/min", [&](auto e, auto) { return 0.06 * speed(e); });
  rig.add("Spindle [1/min]", [&](auto e, auto) { return 1.9 * speed(e) + (e == 5 ? 30 : 0); });
  rig.add("weight [kg]", [&](auto e, auto) { return 2.7 * pressure(e); });
  rig.add("oil [g/m2]", [&](auto e, auto) { return 2.7 * pressure(e); });
  rig.add("strain [%]", [&](auto e, auto) { return 0.1 * speed(e); });
  rig.add("F2 [kN]", [&](auto e, auto i) { return 0.6 * pressure(e) + 0.001 * double(i % 3); });
  rig.add("tension [kN]", [&](auto e, auto) { return 0.6 * pressure(e); });
  data::DataOptions options;
  options.columns["sigma_n_MPa"].formula = "F2/0.6";
  const Dataset data = with_roles(rig.data, options);
  for (const char* set : {"Drehzahl [1/min]", "rpm set", "Speed m/min"})
    EXPECT_EQ(data.find(set)->why, "the set v_rel_mm_s, which is measured") << set;
  for (const char* set : {"weight [kg]", "tension [kN]"})
    EXPECT_EQ(role_of(data, set), Role::ignore) << set;
  for (const char* other : {"Spindle [1/min]", "oil [g/m2]", "strain [%]"})
    EXPECT_EQ(role_of(data, other), Role::setting) << other;
  options.roles["rpm set"] = {Role::setting, {}};
  EXPECT_EQ(role_of(with_roles(rig.data, options), "rpm set"), Role::setting);
}

TEST(Roles, NamesOfCombinationsAreBookkeeping) {
  Rig rig(15, 48, 20);
  const auto text = [&](const char* name, std::vector<std::string> levels, auto of_test) {
    rig.add(name, [&](auto e, auto) { return double(of_test(e)); });
    rig.data.columns.back().levels = std::move(levels);
  };
  // Loads of the rig: 20, 40, 80 and 160 MPa, by e % 4.
  const auto oil = [](std::size_t e) { return e / 4 % 3; };
  text("lubricant", {"Base", "Ferro", "ZDDP"}, oil);
  std::vector<std::string> names, codes, batches;
  for (const char* const one : {"Base", "Ferro", "ZDDP"})
    for (const int load : {20, 40, 80, 160}) {
      names.push_back(std::string(one) + "_" + std::to_string(load) + "MPa");
      codes.push_back("C" + std::to_string(codes.size() + 1));
      batches.push_back("H" + std::to_string(800 + 7 * batches.size()));
    }
  const auto combination = [&](std::size_t e) { return 4 * oil(e) + e % 4; };
  text("set of four", names, combination);
  text("condition_id", codes, combination);
  text("heat", batches, combination); // a batch that was tried at one load alone
  text("series", {"I", "II", "III"}, oil);
  text("operator", {"A", "B"}, [](std::size_t e) { return e / 12 % 2; });
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "lubricant"), Role::label);
  EXPECT_EQ(role_of(data, "operator"), Role::label);
  for (const char* name : {"set of four", "condition_id"}) {
    EXPECT_EQ(role_of(data, name), Role::ignore) << name;
    EXPECT_THAT(data.find(name)->why, HasSubstr("names combinations of sigma_n_MPa, ")) << name;
  }
  EXPECT_EQ(data.find("heat")->why, "12 levels");
  data::DataOptions options;
  options.roles["condition_id"] = {Role::label, {}};
  EXPECT_EQ(role_of(with_roles(rig.data, options), "condition_id"), Role::label);
}

TEST(Roles, AReadingThatHardlyMovesWithinTestsIsASetting) {
  Rig rig(16, 20, 60);
  const auto air = rig.of_tests([&] { return 30 + 30 * rig.uniform(); });
  rig.add("Humidity [%]", [&](auto e, auto) { return air[e] + 0.03 * rig.normal(); });
  rig.add("Draught", [&](auto e, auto) { return air[e] + 3 * rig.normal(); });
  rig.add("sound", [&](auto, auto i) { return std::sqrt(rig.at("tau_R_MPa", i)); });
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "Humidity [%]"), Role::setting);
  EXPECT_THAT(data.find("Humidity [%]")->why, HasSubstr(" in a test, "));
  EXPECT_EQ(role_of(data, "Draught"), Role::channel);
  EXPECT_NE(role_of(data, "sound"), Role::setting) << "it moves as friction does";
}

TEST(Roles, TheSurroundingsAreSettingsOfWhichTheMeanOfATestCounts) {
  Rig rig(16, 40, 60);
  const auto air = rig.of_tests([&] { return 30 + 30 * rig.uniform(); });
  rig.add("RH [%]", [&](auto e, auto) { return air[e] + 1.2 * rig.normal(); });
  rig.add("Signal", [&](auto e, auto) { return air[e] + 1.2 * rig.normal(); });
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "RH [%]"), Role::setting);
  EXPECT_EQ(role_of(data, "Signal"), Role::channel) << "nothing says that it is of the room";
  const auto humidity = data.values("RH [%]");
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
      EXPECT_EQ(humidity[i], humidity[data.first_row[e]]);
  EXPECT_THAT(data.notes, Contains(HasSubstr("the mean of each test is taken")));
}

TEST(Roles, ASettingThatFewTestsLackIsTakenInTheMiddleOfTheOthers) {
  Rig rig(17, 12, 5);
  const auto of_test = [](std::size_t lacking) {
    return [=](std::size_t e, std::size_t) { return e < lacking ? std::nan("") : double(e % 5); };
  };
  rig.add("Ra", of_test(3));
  rig.add("Rz", of_test(5));
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(data.values("Ra")[0], 2) << "of 3, 4, 0, 1, 2, 3, 4, 0, 1";
  EXPECT_TRUE(std::isnan(data.values("Rz")[0])) << "more than a third";
  EXPECT_THAT(data.cautions, testing::ElementsAre("Ra has no value in 3 of 12 tests, first in "
                                                  "'t0': taken as 2, the middle of the others"));
}

TEST(Roles, ASettingThatFrictionFollowsTooCloselyIsAskedAbout) {
  Rig rig(18, 12, 1);
  rig.add("shape", [&](auto, auto i) {
    return std::pow(rig.at("tau_R_MPa", i) / rig.at("sigma_n_MPa", i), 3) * (1 + 1e-4 * double(i));
  });
  rig.add("dose", [&](auto, auto i) { return double(i * 7 % 12); });
  Dataset data = rig.data;
  Dataset* const parts[] = {&data};
  data::ask_if_reading(parts, "dose");
  EXPECT_THAT(data.cautions, testing::IsEmpty());
  data::ask_if_reading(parts, "shape");
  EXPECT_THAT(data.cautions, Contains(HasSubstr("is shape known before its test?")));
}

TEST(Roles, ShapesOfRingsAndCupsAreOutcomes) {
  Rig rig(19, 8, 1);
  for (const char* name : {"Cup height ratio Hu/Hl", "ID1 (mm)", "ID change (%)",
                           "OD barrel max (mm)", "Fmax (kN)", "H0 (mm)", "Height reduction (%)"})
    rig.add(name, [&](auto e, auto) { return 10 + double(e * e % 7); });
  const Dataset data = with_roles(rig.data);
  for (const char* name : {"Cup height ratio Hu/Hl", "Fmax (kN)"})
    EXPECT_EQ(role_of(data, name), Role::outcome) << name;
  EXPECT_NE(role_of(data, "H0 (mm)"), Role::outcome);
  EXPECT_NE(role_of(data, "Height reduction (%)"), Role::outcome);
}

TEST(Roles, ANameThatTheDataDoNotHaveIsAFault) {
  Rig rig(1, 4, 5);
  data::DataOptions options;
  options.roles["flim_nm"] = {Role::channel, {"job.toml", 7, 3}};
  options.roles["sigma_n_MPa"] = {Role::ignore, {"job.toml", 8, 3}};
  try {
    with_roles(rig.data, options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("job.toml:7:3: error: data.roles: the data have no column "
                                        "'flim_nm'"));
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'film_nm'?"));
    EXPECT_THAT(error.what(), HasSubstr("data.roles: sigma_n_MPa is a quantity"));
  }
}

// Three oils, a file each, measured at six speeds: not a remark, but what the files differ by.
TEST(Roles, OfATextOfEachRecordingIsALabelWhereItNamesWhatRubs) {
  Rig rig(1, 18, 20);
  for (std::size_t e = 0; e < 18; ++e)
    rig.data.recording.push_back(e / 6);
  for (const char* name : {"Lubricant", "Title"}) {
    rig.add(name, [](std::size_t test, std::size_t) { return double(test / 6); });
    rig.data.columns.back().levels = {"a", "b", "c"};
  }
  const Dataset data = with_roles(rig.data);
  EXPECT_EQ(role_of(data, "Lubricant"), Role::label);
  EXPECT_EQ(role_of(data, "Title"), Role::ignore);
  EXPECT_THAT(data.find("Title")->why, HasSubstr("3 values in 3 recordings"));
}

} // namespace frictab::roles_test
