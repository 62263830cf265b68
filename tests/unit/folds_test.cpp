// Cross-validation never learns from an experiment it is judged on.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "calibrate/folds.h"
#include "core/error.h"
#include "core/random.h"

namespace frictab::folds_test {

using calibrate::experiment_folds;
using data::Dataset;

namespace {

Dataset campaign(std::size_t experiments, std::size_t rows) {
  Dataset data;
  data.columns = {{"tau_R_MPa", "MPa", {}, {}}};
  for (std::size_t e = 0; e < experiments; ++e) {
    for (std::size_t i = 0; i < rows; ++i)
      data.columns[0].values.push_back(static_cast<double>(100 * e + i));
    data.experiments.push_back("E" + std::to_string(e));
    data.first_row.push_back(data.columns[0].values.size());
  }
  data.sources = {"rig.csv"};
  return data;
}

std::vector<std::string> in_both(const Dataset& a, const Dataset& b) {
  std::vector<std::string> shared;
  for (const std::string& name : b.experiments)
    if (std::ranges::count(a.experiments, name) > 0) shared.push_back(name);
  return shared;
}

TEST(Folds, AreBalancedAndEveryExperimentIsInExactlyOne) {
  for (const std::size_t experiments : {5, 7, 81, 100})
    for (std::uint64_t repeat = 0; repeat < 3; ++repeat) {
      const auto fold = experiment_folds(experiments, 5, 1, repeat);
      ASSERT_EQ(fold.size(), experiments);
      std::vector<std::size_t> size(5, 0);
      for (const std::size_t f : fold)
        ++size.at(f);
      const auto [low, high] = std::ranges::minmax_element(size);
      EXPECT_GE(*low, 1U);
      EXPECT_LE(*high - *low, 1U);
    }
}

TEST(Folds, RepeatBySeedAndDifferBetweenSeedsAndRepeats) {
  const auto fold = experiment_folds(81, 5, 3, 0);
  EXPECT_EQ(experiment_folds(81, 5, 3, 0), fold);
  EXPECT_NE(experiment_folds(81, 5, 4, 0), fold);
  EXPECT_NE(experiment_folds(81, 5, 3, 1), fold);
}

TEST(Folds, AreRefusedWhereAFoldWouldBeEmpty) {
  EXPECT_THROW(experiment_folds(4, 5, 1, 0), InputError);
  EXPECT_THROW(experiment_folds(10, 1, 1, 0), InputError);
  EXPECT_NO_THROW(experiment_folds(5, 5, 1, 0));
}

TEST(Folds, PartsMadeFromThemShareNoExperiment) {
  const Dataset data = campaign(23, 4);
  const auto fold = experiment_folds(23, 4, 9, 2);
  for (std::size_t f = 0; f < 4; ++f) {
    std::vector<std::size_t> in, out;
    for (std::size_t e = 0; e < fold.size(); ++e)
      (fold[e] == f ? out : in).push_back(e);
    EXPECT_TRUE(in_both(data.subset(in), data.subset(out)).empty());
  }
}

TEST(Folds, HoldOutSharesNoExperimentBetweenItsParts) {
  const Dataset data = campaign(23, 4);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const data::Split split = data::hold_out(data, 0.3, seed);
    EXPECT_TRUE(in_both(split.training, split.validation).empty());
  }
}

TEST(Folds, EqualRowsInTwoFilesAreToldAndEqualNamesAreNot) {
  const Dataset training = campaign(6, 10);
  Dataset validation = campaign(4, 10); // the first four of the six
  EXPECT_EQ(calibrate::leak_note(training, validation),
            "4 of 4 validation experiments have the rows of a training experiment ('E0' those of "
            "'E0'): errors on them are not errors of prediction");
  for (double& x : validation.columns[0].values)
    x += 1000; // another rig that also counts from E0
  EXPECT_EQ(calibrate::leak_note(training, validation), "");
  validation.columns[0].values[25] = 205; // one row alone is chance
  EXPECT_EQ(calibrate::leak_note(training, validation), "");
}

// SYNTHETIC tests of a coefficient with noise: repeats, and copies with other noise on top.
Dataset noisy(std::size_t experiments, std::size_t rows, double level, Random& random) {
  Dataset data;
  data.columns = {{"tau_R_MPa", "MPa", {}, {}}};
  data.first_row = {0};
  for (std::size_t e = 0; e < experiments; ++e) {
    data.experiments.push_back("R" + std::to_string(e));
    const double factor = 1 + level * random.normal();
    for (std::size_t i = 0; i < rows; ++i) {
      const double ramp = 1 - std::exp(-0.1 * static_cast<double>(i));
      data.columns[0].values.push_back(100 * factor * ramp + random.normal());
    }
    data.first_row.push_back(data.columns[0].values.size());
  }
  return data;
}

TEST(Folds, CopiesWithValuesChangedALittleAreToldAndRepeatsAreNot) {
  Random random(3);
  for (const std::size_t rows : {25, 100, 550}) {
    // Repeats that differ by next to nothing but their noise: 60 of them are 1,770 pairs.
    const Dataset repeats = noisy(60, rows, 0.001, random);
    EXPECT_EQ(calibrate::leak_note(repeats, repeats), "") << rows;
    Dataset copies = repeats.subset(std::array{3UL, 7UL});
    for (double& stress : copies.columns[0].values)
      stress *= 1 + 0.002 * random.normal();
    EXPECT_EQ(
        calibrate::leak_note(repeats, copies),
        "2 of 2 validation experiments have the rows of a training experiment, 2 of them with "
        "values changed a little ('R3' those of 'R3'): errors on them are not errors of "
        "prediction")
        << rows;
  }
}

// SYNTHETIC repeats of one programme: steps of the pressure, on which a servo swings.
TEST(Folds, RepeatsOfOneProgrammeAreNoCopies) {
  Random random(4);
  for (const double noise : {0.002, 0.01}) {
    for (const double swing : {0.0, 0.02}) {
      Dataset data;
      data.columns = {{"sigma_n_MPa", "MPa", {}, {}}, {"tau_R_MPa", "MPa", {}, {}}};
      data.first_row = {0};
      for (std::size_t e = 0; e < 20; ++e) {
        const double mu = 0.12 * (1 + 0.003 * random.normal());
        for (std::size_t i = 0; i < 600; ++i) {
          const double pressure = 5 * std::pow(2.0, double(i / 150)) *
                                  (1 + swing * std::sin(2.2 * double(i))) *
                                  (1 + noise * random.normal());
          data.columns[0].values.push_back(pressure);
          data.columns[1].values.push_back(mu * pressure * (1 + noise * random.normal()));
        }
        data.experiments.push_back("P" + std::to_string(e));
        data.first_row.push_back(data.columns[0].values.size());
      }
      EXPECT_EQ(calibrate::leak_note(data, data), "") << noise << ", " << swing;
    }
  }
}

// Rows of a computation have a course and no noise; tests of other states have other values.
TEST(Folds, TestsOfOneCourseAtOtherLevelsAreNoCopies) {
  Dataset data = campaign(1, 100);
  data.columns = {{"tau_R_MPa", "MPa", {}, {}}};
  data.experiments.clear();
  data.first_row = {0};
  for (const double level : {100.0, 104.0, 108.0}) {
    data.experiments.push_back(std::to_string(level));
    for (int i = 0; i < 100; ++i)
      data.columns[0].values.push_back(level * (1 - std::exp(-0.1 * i)));
    data.first_row.push_back(data.columns[0].values.size());
  }
  EXPECT_EQ(calibrate::leak_note(data, data), "");
}

} // namespace
} // namespace frictab::folds_test
