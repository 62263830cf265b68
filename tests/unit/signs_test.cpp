// Claims: forces and speeds with a sign are read as magnitudes; which way a row went, the zero of
// the force cell and rows that are not fitted are told.
#include "data/signs.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/random.h"
#include "data/load_condensed.h"
#include "data/plausibility.h"
#include "unit/load_case.h"

namespace frictab::signs_test {
namespace {

using data::Dataset;
using data::ForceZero;
using data::load_dataset;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::Not;

constexpr double mu = 0.12;

class Signs : public test::LoadCase {
protected:
  void SetUp() override {
    LoadCase::SetUp();
    options.columns["sigma_n_MPa"].names = {"F_N"};
    options.columns["tau_R_MPa"].names = {"F_T"};
    for (const char* stress : {"sigma_n_MPa", "tau_R_MPa"})
      options.columns[stress].area_mm2 = 20;
    options.columns["v_rel_mm_s"].names = {"v"};
  }

  // Strokes of 50 rows; `zero` and `share` (of the load) are added to what rubs.
  static std::string there_and_back(double load, double zero, double share, std::uint64_t seed,
                                    bool polarity = true) {
    Random random(seed, 0);
    std::string text = "time_s,F_N,F_T,v\n";
    for (int i = 0; i < 300; ++i) {
      const double sign = i / 50 % 2 == 0 ? 1 : -1;
      const double force = sign * mu * load * (1 + 0.02 * random.normal()) + zero + share * load;
      text += fmt::format("{},{},{},{}\n", 0.1 * i, load * (1 + 0.01 * random.normal()),
                          polarity ? force : -force, 20 * sign);
    }
    return text;
  }
  std::vector<std::string> campaign(double zero, double share) {
    std::vector<std::string> files;
    for (int t = 0; t < 5; ++t)
      files.push_back(file(fmt::format("t{}.csv", t),
                           there_and_back(500.0 * (t + 1), zero, share, std::uint64_t(t))));
    return files;
  }
  void by_formula(const std::string& column, const std::string& formula) {
    options.columns[column] = {};
    options.columns[column].formula = formula;
  }
  static double mean_mu(const Dataset& data, double direction) {
    const auto tau = data.values("tau_R_MPa"), load = data.values("sigma_n_MPa"),
               way = data.values("direction");
    double sum = 0, rows = 0;
    for (std::size_t i = 0; i < tau.size(); ++i)
      if (way[i] == direction) {
        sum += tau[i] / load[i];
        ++rows;
      }
    return sum / rows;
  }
};

TEST_F(Signs, TheZeroOfTheForceCellIsTheMeanOfBothDirections) {
  const Dataset data = load_dataset(campaign(20, 0), options);
  EXPECT_NEAR(mean_mu(data, 1), mu, 0.0005);
  EXPECT_NEAR(mean_mu(data, -1), mu, 0.0005);
  EXPECT_THAT(column(data, "v_rel_mm_s"), Each(20));
  EXPECT_THAT(data.notes, Contains(HasSubstr("twice 0.9")));
  EXPECT_THAT(data.notes, Contains(HasSubstr("taken off as the zero of the force cell: it is the "
                                             "same at every load")));
  EXPECT_EQ(data.interventions.size(), 1u);
  EXPECT_GT(data.phases[std::size_t(data::Phase::turning)], 5u * 6 * 2);
}

TEST_F(Signs, AZeroAboveTheFrictionIsTakenOffToo) {
  for (const double zero : {120.0, -1000.0}) { // friction is 60 to 300 N
    const Dataset data = load_dataset(campaign(zero, 0), options);
    EXPECT_NEAR(mean_mu(data, 1), mu, 0.001) << zero;
    EXPECT_NEAR(mean_mu(data, -1), mu, 0.001) << zero;
    EXPECT_THAT(data.notes, Contains(HasSubstr("which is above the friction in"))) << zero;
  }
  options.force_zero = ForceZero::remove; // one load: only the job can say it
  EXPECT_NEAR(mean_mu(read(there_and_back(500, 200, 0, 1)), -1), mu, 0.0005);
}

// Four tests of a day, with pauses of 30 rows at rest and without load; mu is that of the load.
std::string day(std::size_t number) {
  Random random(number, 3);
  std::string text = "time_s,F_N,F_T,v\n";
  int row = 0;
  for (const double load : {500.0, 1000.0, 1000.0, 2000.0}) {
    for (int i = 0; i < 130; ++i, ++row) {
      const bool slides = i >= 30;
      const double force = slides ? load * (1 + 0.01 * random.normal()) : 0.5 * random.normal();
      text += fmt::format("{},{},{},{}\n", 0.1 * row, force, slides ? 0.1 * force : 0.0,
                          slides ? 20 + 0.1 * random.normal() : 0.0);
    }
  }
  return text;
}

TEST_F(Signs, PausesPartTestsWhereTheJobSaysSo) {
  const std::vector<std::string> files = {file("d1.csv", day(1)), file("d2.csv", day(2))};
  Dataset data = load_dataset(files, options);
  EXPECT_EQ(data.experiments.size(), 2u);
  EXPECT_THAT(data.notes, Contains(HasSubstr("2 tests ('d1', 'd2') slide 4 times at other loads "
                                             "or speeds, with pauses between")));
  options.experiment = "pause";
  data = load_dataset(files, options);
  EXPECT_THAT(data.experiments,
              testing::ElementsAre("d1 1", "d1 2", "d1 3", "d1 4", "d2 1", "d2 2", "d2 3", "d2 4"));
  EXPECT_EQ(data.rows(), 800u);
  EXPECT_THAT(data.notes, Not(Contains(HasSubstr("with pauses between"))));
  EXPECT_NEAR(data.values("sigma_n_MPa")[350], 100, 5); // of d1 4
}

// A shear stress at its limit is the same at every load.
TEST_F(Signs, AMagnitudeThatDiffersByDirectionIsNoZero) {
  for (const double exponent : {0.0, 0.5, 1.0}) {
    std::vector<std::string> files;
    for (int t = 0; t < 5; ++t) {
      const double apart = exponent == 0 ? 0.01 * (1 + t) : 0.05; // misaligned, each in its own way
      std::string text = "time_s,F_N,F_T,v\n";
      const double load = 500.0 * (t + 1), friction = 60 * std::pow(t + 1, exponent);
      for (int i = 0; i < 300; ++i) {
        const double sign = i / 50 % 2 == 0 ? 1 : -1;
        text += fmt::format("{},{},{},{}\n", 0.1 * i, load,
                            friction * (1 + apart * sign + 0.001 * (i % 7)), 20 * sign);
      }
      files.push_back(file(fmt::format("t{}.csv", t), text));
    }
    const Dataset data = load_dataset(files, options);
    EXPECT_NEAR(data.values("tau_R_MPa")[10], 62.0 / 20, 0.1) << exponent;
  }
}

TEST_F(Signs, WhatGrowsWithTheLoadIsFrictionAndStays) {
  const Dataset data = load_dataset(campaign(0, 0.02), options);
  EXPECT_NEAR(mean_mu(data, 1), mu + 0.02, 0.0005);
  EXPECT_NEAR(mean_mu(data, -1), mu - 0.02, 0.0005);
  EXPECT_THAT(data.notes, Contains(HasSubstr("it is in proportion to the load, so friction")));
  options.force_zero = ForceZero::remove;
  EXPECT_NEAR(mean_mu(load_dataset(campaign(0, 0.02), options), 1), mu, 0.0005);
}

TEST_F(Signs, OneLoadCannotTellAndTheNoteAsks) {
  const Dataset data = read(there_and_back(500, 10, 0, 1));
  EXPECT_NEAR(mean_mu(data, -1), mu, 0.0005);
  EXPECT_THAT(data.notes, Contains(HasSubstr("data.force_zero = \"remove\" or \"keep\"")));
  options.force_zero = ForceZero::keep;
  EXPECT_NEAR(mean_mu(read(there_and_back(500, 10, 0, 1)), 1), mu + 0.02, 0.0005);
}

TEST_F(Signs, TheZeroMayDriftFromCycleToCycle) {
  for (const double drift : {0.0, 1.0}) { // N per cycle, at a friction of 60 N that runs in
    Random random(3, 0);
    std::string text = "time_s,F_N,F_T,v\n";
    for (int i = 0; i < 1000; ++i) {
      const double sign = i / 50 % 2 == 0 ? 1 : -1, runs_in = 1 + 0.5 * std::exp(-0.005 * i);
      text += fmt::format("{},500,{},{}\n", 0.1 * i,
                          sign * mu * 500 * runs_in * (1 + 0.005 * random.normal()) + 5 +
                              drift * (i / 100),
                          20 * sign);
    }
    const Dataset data = read(text);
    const auto tau = data.values("tau_R_MPa"), way = data.values("direction");
    double last[2] = {}, rows[2] = {};
    for (std::size_t i = data.rows() - 100; i < data.rows(); ++i) {
      last[way[i] > 0] += tau[i];
      ++rows[way[i] > 0];
    }
    EXPECT_NEAR(last[0] / rows[0], last[1] / rows[1], 0.02 * 3) << drift;
    EXPECT_EQ(std::count_if(
                  data.notes.begin(), data.notes.end(),
                  [](const std::string& note) {
                    return note.find("the zero of the force cell drifts in 1 of the tests") == 0;
                  }),
              drift > 0)
        << drift;
  }
}

// Loops of 200 rows without a clock, which begin just after a turn; the force builds up over 20.
TEST_F(Signs, TheZeroOfLoopsIsOfRowsInFullMotion) {
  options.columns.erase("v_rel_mm_s");
  for (const double zero : {3.0, -6.0}) {
    std::vector<std::string> files;
    for (const double load : {100.0, 200.0, 400.0}) {
      std::string text = "F_N,F_T\n";
      for (int i = 0; i < 200; ++i) {
        const double sign = i < 100 ? 1 : -1, built = std::min(1.0, i % 100 / 20.0);
        text += fmt::format("{},{}\n", load + 0.01 * (i % 5),
                            sign * mu * load * (2 * built - 1) + zero);
      }
      files.push_back(file(fmt::format("l{}.csv", load), text));
    }
    const Dataset data = load_dataset(files, options);
    const auto tau = data.values("tau_R_MPa"), pressure = data.values("sigma_n_MPa");
    for (std::size_t e = 0; e < 3; ++e)
      for (const double way : {1.0, -1.0}) {
        std::vector<double> coefficients;
        for (std::size_t i = data.first_row[e]; i < data.first_row[e + 1]; ++i)
          if (data.values("direction")[i] == way) coefficients.push_back(tau[i] / pressure[i]);
        ASSERT_GT(coefficients.size(), 50u);
        std::sort(coefficients.begin(), coefficients.end());
        EXPECT_NEAR(coefficients[coefficients.size() / 2], mu, 0.02 * mu)
            << zero << " " << e << way;
      }
  }
}

TEST_F(Signs, StrokesWithPausesAtOneSpeedAreNoOtherTests) {
  std::string text = "time_s,F_N,F_T,v\n";
  for (int i = 0; i < 600; ++i) { // an odd number of strokes in each piece
    const int row = i % 200;
    const double sign = row / 50 % 2 == (i / 200) % 2 ? 1 : -1, speed = row < 150 ? 20 * sign : 0;
    text += fmt::format("{},500,{},{}\n", 0.1 * i, speed == 0 ? 0 : sign * 60, speed);
  }
  EXPECT_THAT(read(text).notes, Not(Contains(HasSubstr("at other loads or speeds"))));
}

// However the sensor is mounted, and however the job makes a speed of what was recorded.
TEST_F(Signs, PolarityAndHowTheSpeedIsMadeDoNotMatter) {
  const Dataset plain = read(there_and_back(500, 10, 0, 7));
  const Dataset other = read(there_and_back(500, 10, 0, 7, false));
  EXPECT_EQ(column(plain, "tau_R_MPa"), column(other, "tau_R_MPa"));
  for (const char* formula : {"abs(v)", "sqrt(v^2)", "sqrt(v*v)", "(v**2)^0.5", "max(v, -v)"}) {
    by_formula("v_rel_mm_s", formula);
    const Dataset data = read(there_and_back(500, 10, 0, 7));
    EXPECT_EQ(column(data, "direction"), column(plain, "direction")) << formula;
    EXPECT_EQ(column(data, "tau_R_MPa"), column(plain, "tau_R_MPa")) << formula;
  }
  by_formula("tau_R_MPa", "abs(F_T)/20");
  EXPECT_EQ(column(read(there_and_back(500, 10, 0, 7)), "tau_R_MPa"), column(plain, "tau_R_MPa"));
  by_formula("v_rel_mm_s", "abs(v) + abs(v)"); // whatever that is
  EXPECT_THAT(column(read(there_and_back(500, 10, 0, 7)), "v_rel_mm_s"), Each(40));
}

TEST_F(Signs, FrictionThatIsAMagnitudeAlreadyHasNoOffset) {
  std::string text = "time_s,F_N,F_T,v\n";
  for (int i = 0; i < 300; ++i)
    text += fmt::format("{},500,{},{}\n", 0.1 * i, 50 + i % 3, i / 50 % 2 == 0 ? 20 : -20);
  const Dataset data = read(text);
  EXPECT_THAT(column(data, "tau_R_MPa"), Each(testing::AllOf(testing::Ge(2.5), testing::Le(2.6))));
  EXPECT_THAT(data.notes, Not(Contains(HasSubstr("both signs"))));
  EXPECT_TRUE(data.has("direction"));
}

std::string one_way(double force, double load, double speed) {
  std::string text = "time_s,F_N,F_T,v\n";
  for (int i = 0; i < 40; ++i)
    text += fmt::format("{},{},{},{}\n", 0.1 * i, load + i % 3, force + i % 5 * 0.1, speed);
  return text;
}

// A row that is the mean of a stroke turns nowhere.
TEST_F(Signs, RowsMayBeWholeStrokes) {
  std::string text = "F_N,F_T,v\n";
  for (int i = 0; i < 30; ++i)
    text += fmt::format("500,{},{}\n", i % 2 == 0 ? 60 : -55, i % 2 == 0 ? 20 : -20);
  const Dataset data = read(text);
  EXPECT_EQ(data.rows(), 30u);
  EXPECT_EQ(data.values("direction")[1], -1);
  EXPECT_NEAR(data.values("tau_R_MPa")[1], 57.5 / 20, 1e-9);
}

TEST_F(Signs, OneSignAllAlongIsAConvention) {
  const std::vector<std::string> files = {file("a.csv", one_way(-50, -500, -20)),
                                          file("b.csv", one_way(-60, -500, -30))};
  Dataset data = load_dataset(files, options);
  EXPECT_THAT(column(data, "tau_R_MPa"), Each(testing::Gt(2)));
  EXPECT_THAT(column(data, "sigma_n_MPa"), Each(testing::Gt(24)));
  EXPECT_THAT(data.notes, Contains(HasSubstr("tau_R_MPa is negative all along in 2 tests ('a', "
                                             "'b'): a convention")));
  EXPECT_THAT(data.notes, Contains("sigma_n_MPa is negative all along in 2 of the tests: a "
                                   "convention, taken as compression"));
  data::settle_directions(std::array{&data});
  EXPECT_FALSE(data.has("direction"));
}

TEST_F(Signs, TestsThatGoOneWayEachHaveADirection) {
  const std::vector<std::string> files = {file("a.csv", one_way(50, 500, 20)),
                                          file("b.csv", one_way(-60, 500, -20)),
                                          file("c.csv", one_way(50, 500, 30))};
  Dataset data = load_dataset(files, options);
  data::settle_directions(std::array{&data});
  EXPECT_EQ(data.values("direction")[0], 1);
  EXPECT_EQ(data.values("direction")[40], -1);
  EXPECT_EQ(data.values("direction")[80], 1);
  // By the sign of friction, where the speed has none; whichever file comes first.
  const std::vector<std::string> turned = {file("a.csv", one_way(-60, 500, 20)),
                                           file("b.csv", one_way(50, 500, 20))};
  data = load_dataset(turned, options);
  data::settle_directions(std::array{&data});
  EXPECT_EQ(data.values("direction")[0], -1);
  EXPECT_EQ(data.values("direction")[40], 1);
}

TEST_F(Signs, BlocksHaveOneDirection) {
  const std::vector<std::string> files = campaign(20, 0);
  const Dataset rows = load_dataset(files, options), blocks = load_condensed(files, options, 10);
  EXPECT_THAT(column(blocks, "direction"), Each(testing::AnyOf(1, -1)));
  EXPECT_EQ(blocks.phases, rows.phases);
  EXPECT_EQ(blocks.source_rows(), rows.rows());
  EXPECT_NEAR(mean_mu(blocks, 1), mu, 0.001);
}

// ---- rows that are not fitted ----

std::string with_rest(int rest, int sliding) {
  std::string text = "time_s,F_N,F_T,v\n";
  for (int i = 0; i < rest + sliding; ++i)
    text += fmt::format("{},{},{},{}\n", 0.1 * i, 500 + i % 3, i < rest ? i : 60 + i % 2,
                        i < rest ? 0 : 20);
  return text;
}

TEST_F(Signs, RowsAtRestAreLeftOutCountedAndKeptAside) {
  const Dataset data = read(with_rest(10, 50));
  EXPECT_EQ(data.rows(), 50u);
  EXPECT_EQ(data.phases[std::size_t(data::Phase::rest)], 10u);
  ASSERT_EQ(data.dropped.size(), 1u);
  EXPECT_EQ(data.dropped[0].rows, 10u);
  ASSERT_TRUE(data.aside);
  EXPECT_EQ(data.aside->rows(), 10u);
  EXPECT_EQ(data.aside->values("row")[9], 10);
  EXPECT_DOUBLE_EQ(data.values("s_mm").front(), 1); // the path is that of all rows
  options.rows = data::UsedRows::all;
  EXPECT_EQ(read(with_rest(10, 50)).rows(), 60u);
  EXPECT_EQ(read(with_rest(10, 50)).phases[std::size_t(data::Phase::rest)], 10u);
  options.rows = data::UsedRows::sliding;
  options.measured = false; // rows to predict
  EXPECT_EQ(read(with_rest(10, 50)).rows(), 60u);
}

TEST_F(Signs, ATestThatNeverSlidesIsNamed) {
  const std::vector<std::string> files = {file("still.csv", with_rest(30, 0)),
                                          file("slides.csv", with_rest(0, 30))};
  const Dataset data = load_dataset(files, options);
  EXPECT_THAT(data.experiments, testing::ElementsAre("slides"));
  EXPECT_THAT(data.notes, Contains(HasSubstr("no row of test 'still' slides: left out")));
  const Dataset only = load_dataset({"still.csv"}, options);
  EXPECT_EQ(only.rows(), 30u);
  EXPECT_THAT(only.notes, Contains(HasSubstr("no row slides")));
}

TEST_F(Signs, ASpeedCellThatIsNotThereIsSaid) {
  options.columns.erase("v_rel_mm_s");
  EXPECT_THAT(read("F_N,F_T\n500,60\n500,61\n500,60\n").notes,
              Contains(HasSubstr("rows have no phases of motion")));
}

TEST_F(Signs, AReadingAtRestThatNoLoadChangesIsAZeroPoint) {
  const auto campaign_with = [&](double zero, double share) {
    std::vector<std::string> files;
    for (int t = 0; t < 4; ++t) {
      const double load = 1000.0 * (t + 1);
      std::string text = "time_s,F_N,F_T,v\n";
      for (int i = 0; i < 60; ++i)
        text += fmt::format("{},{},{},{}\n", 0.1 * i, load + i % 3,
                            zero + (i < 15 ? share : mu) * load + 0.1 * (i % 4), i < 15 ? 0 : 20);
      files.push_back(file(fmt::format("z{}.csv", t), text));
    }
    return load_dataset(files, options).implausible;
  };
  EXPECT_THAT(campaign_with(150, 0),
              Contains(HasSubstr("tau_R_MPa shows 7.5 MPa at rest in 4 tests of all loads, "
                                 "up to 56 % of what it shows in sliding: a zero point")));
  EXPECT_THAT(campaign_with(150, 0), Contains(HasSubstr("{ formula = \"COLUMN - 7.5\" } does for a "
                                                        "column in MPa")));
  EXPECT_THAT(campaign_with(0, 0.06), Not(Contains(HasSubstr("at rest")))) << "held by friction";
  EXPECT_THAT(campaign_with(0, 0), Not(Contains(HasSubstr("at rest"))));
}

TEST_F(Signs, RowsThatMayBeAtRestAreSaidWhereNoColumnShowsMotion) {
  options.columns.erase("v_rel_mm_s");
  std::string text = "time_s,F_N,F_T\n";
  for (int i = 0; i < 60; ++i)
    text += fmt::format("{},{},{}\n", 0.1 * i, 1000 + i % 3, i < 12 ? 0.2 : 120 + i % 4);
  const std::vector<data::Implausible> found = data::find_implausible(read(text));
  const auto one = std::find_if(found.begin(), found.end(),
                                [](const auto& any) { return any.check == "no_motion"; });
  ASSERT_NE(one, found.end());
  EXPECT_EQ(one->rows, 12u);
}

TEST_F(Signs, RestIsSaidAndCountedWhereTheSpeedIsASetOne) {
  std::string text = "time_s,F_N,F_T,v,Ring Speed [rpm]\n", longer = text;
  for (int i = 0; i < 100; ++i) {
    text += fmt::format("{},1000,{},20,{}\n", 0.1 * i, i < 96 ? 120 + i % 4 : 1, i < 96 ? 72 : 0);
    longer += fmt::format("{},1000,{},20,70\n", 0.1 * i, i < 85 ? 120 + i % 4 : 1);
  }
  const Dataset data = read(text);
  EXPECT_EQ(data.phases[std::size_t(data::Phase::rest)], 4u);
  EXPECT_EQ(data.rows(), 96u);
  EXPECT_THAT(data.notes,
              Contains("at rest, though v_rel_mm_s does not show it: 4 of the rows have "
                       "Ring Speed [rpm] next to 0 and less than half of the friction"));
  // Too many to be called rest without a reading of the motion: said, and fitted.
  const Dataset many = read(longer);
  EXPECT_EQ(many.rows(), 100u);
  const std::vector<data::Implausible> found = data::find_implausible(many);
  const auto one = std::find_if(found.begin(), found.end(),
                                [](const auto& any) { return any.check == "no_motion"; });
  ASSERT_NE(one, found.end());
  EXPECT_EQ(one->rows, 15u);
}

// ---- rows that no rig can measure ----

std::string with_row(double force, int rows = 100) {
  std::string text = "F_N,F_T,v\n";
  for (int i = 0; i < rows; ++i)
    text += fmt::format("{},{},20\n", 5000 + i % 3, i == 40 ? force : 600 + 3 * (i % 7));
  return text;
}

TEST_F(Signs, OneRowThatNoRigCanMeasureIsNamedAndLeftOut) {
  options.constants["sigma_f_MPa"] = 480;
  for (const auto& [force, check] :
       {std::pair(7000.0, "shear_yield"), std::pair(1500.0, "spike")}) {
    options.allow_implausible.clear();
    const Dataset data = read(with_row(force));
    EXPECT_EQ(data.rows(), 99u);
    ASSERT_EQ(data.apart.size(), 1u);
    EXPECT_EQ(data.apart[0].check, check);
    EXPECT_THAT(data.interventions, Contains(HasSubstr("a.csv:42 in test 'a' (")));
    options.allow_implausible = {check, "friction_coefficient", "spike"};
    EXPECT_EQ(read(with_row(force)).rows(), 100u);
  }
  options.constants.clear();
  options.allow_implausible.clear();
  EXPECT_EQ(read(with_row(20000)).apart[0].check, "friction_coefficient");
  EXPECT_EQ(read(with_row(700)).rows(), 100u); // high, but not by half
  EXPECT_EQ(read(with_row(0)).rows(), 100u);   // upwards only
}

TEST_F(Signs, RowsInWhichATemperatureSensorDropsOutAreLeftOut) {
  const auto with_temperature = [](const auto& at) {
    std::string text = "F_N,F_T,v,T_contact_C\n";
    for (int i = 0; i < 100; ++i)
      text += fmt::format("{},{},20,{}\n", 5000 + i % 3, 600 + 3 * (i % 7), at(i));
    return text;
  };
  const auto pyrometer = [](int i) {
    return i > 19 && i < 23 ? 0 : i == 50 || i > 97 ? 600 : i == 60 ? 760 : 700 + 0.5 * (i % 5);
  };
  const Dataset data = read(with_temperature(pyrometer));
  ASSERT_EQ(data.apart.size(), 1u);
  EXPECT_EQ(data.apart[0].check, "dropout");
  EXPECT_EQ(data.apart[0].rows, 6u) << "760 is there once: a peak may be one";
  EXPECT_THAT(data.interventions, Contains(HasSubstr("a.csv:22 in test 'a' (0 degC)")));
  options.allow_implausible = {"dropout"};
  EXPECT_EQ(read(with_temperature(pyrometer)).rows(), 100u);
  options.allow_implausible.clear();
  const auto heated = [](int i) { return i < 10 ? 23 : std::min(23 + 40 * (i - 9), 700); };
  EXPECT_EQ(read(with_temperature(heated)).rows(), 100u) << "cold until the contact closes";
}

TEST_F(Signs, MoreThanATwentiethOfImpossibleStressesIsAnErrorAndOfSpikesTheyStay) {
  const auto with_eight_rows = [](double force) {
    std::string text = "F_N,F_T,v\n";
    for (int i = 0; i < 100; ++i)
      text += fmt::format("5000,{},20\n", i % 12 == 5 ? force : 600 + i % 7);
    return text;
  };
  options.constants["sigma_f_MPa"] = 480;
  Dataset data = read(with_eight_rows(7000));
  FaultList faults;
  data::check_plausibility(data, {}, {"job.toml", 2, 1}, faults);
  ASSERT_EQ(faults.size(), 1u);
  const std::string said = format_faults(faults.all());
  EXPECT_THAT(said, HasSubstr("job.toml:2:1: error: tau_R_MPa above the shear yield stress"));
  EXPECT_THAT(said, HasSubstr("8 of 100 rows, too many to leave out: a.csv:7 in test 'a' ("));
  EXPECT_THAT(said, HasSubstr("data.allow_implausible = [\"shear_yield\"]"));
  options.allow_implausible = {"shear_yield", "friction_coefficient", "spike"};
  EXPECT_EQ(read(with_eight_rows(7000)).rows(), 100u);

  options.allow_implausible.clear();
  data = read(with_eight_rows(1250)); // of noise, not of a reading that failed
  EXPECT_EQ(data.rows(), 100u);
  EXPECT_TRUE(data.apart.empty());
  EXPECT_TRUE(data.dropped.empty());
}

// Noise about the shear yield stress is noise; a whole test above it is another flow stress.
TEST_F(Signs, AMarkerBelowZeroIsLeftOutAsOneAboveIt) {
  for (const double marker : {9999.0 * 20, -9999.0 * 20}) {
    const Dataset data = read(with_row(marker));
    EXPECT_EQ(data.rows(), 99u) << marker;
    ASSERT_EQ(data.apart.size(), 1u);
    EXPECT_EQ(data.apart[0].check, "friction_coefficient");
  }
}

TEST_F(Signs, RowsWithinTheScatterOfTheirTestStay) {
  options.constants["sigma_f_MPa"] = 480; // k = 277 MPa
  Random random(9, 0);
  std::string text = "F_N,F_T,v\n";
  for (int i = 0; i < 2000; ++i)
    text += fmt::format("9000,{},20\n", 20 * 260 * (1 + 0.12 * random.normal()));
  const Dataset noisy = read(text);
  EXPECT_EQ(noisy.rows(), 2000u);
  EXPECT_EQ(noisy.apart.size(), 0u);
  const std::vector<std::string> files = {file("a.csv", one_way(600, 9000, 20)),
                                          file("b.csv", one_way(8000, 9000, 20))};
  EXPECT_EQ(load_dataset(files, options).apart.size(), 0u);
}

// A peak of static friction where sliding begins is none of them.
TEST_F(Signs, AStaticPeakIsNoSpike) {
  std::string text = "time_s,F_N,F_T,v\n";
  for (int i = 0; i < 120; ++i) {
    const bool rests = i >= 50 && i < 60;
    text += fmt::format("{},500,{},{}\n", 0.1 * i,
                        rests ? 30 + i % 3 : (i < 2 || i == 60 || i == 61 ? 110 : 60 + i % 3),
                        rests ? 0 : 20);
  }
  const Dataset data = read(text);
  EXPECT_EQ(data.rows(), 110u);
  EXPECT_TRUE(data.apart.empty());
}

} // namespace
} // namespace frictab::signs_test
