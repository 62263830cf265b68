// Intervals of one recording: how they are found, numbered, and kept together.
#include <algorithm>
#include <numeric>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "calibrate/cross_validation.h"
#include "calibrate/folds.h"
#include "calibrate/metrics.h"
#include "calibrate/refit.h"
#include "calibrate/replicates.h"
#include "core/random.h"
#include "core/text.h"
#include "data/append.h"
#include "data/recordings.h"
#include "data/roles.h"
#include "load_case.h"

namespace frictab::recordings_test {

using data::Dataset;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

namespace {

using Recordings = test::LoadCase;

// Rows of one test: its clock from `start`, coefficient about `mu`.
std::string rows_from(double start, double mu, unsigned seed = 1, double pressure = 5) {
  std::string text;
  Random random(seed, 0);
  for (int i = 0; i < 20; ++i)
    text += fmt::format("{},{},{},{}\n", start + 0.5 * i, 10 * (mu + 0.002 * random.normal()), 10,
                        pressure);
  return text;
}
const std::string header = "time_s,F_R_N,F_N_N,sigma_n_MPa\n";

std::string intervals(int count, double first_mu) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += header + rows_from(0, first_mu + 0.1 * i, static_cast<unsigned>(i)) + "\n";
  return text;
}

double first_of(const Dataset& data, const std::string& column, std::size_t test) {
  return data.values(column)[data.first_row[test]];
}
std::vector<double> by_test(const Dataset& data, const std::string& column) {
  std::vector<double> values;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    values.push_back(first_of(data, column, e));
  return values;
}

TEST_F(Recordings, OfIntervalsBetweenHeaderLinesAreTheFiles) {
  file("cell b.csv", intervals(3, 0.3));
  file("cell a.csv", intervals(2, 0.3));
  options.experiment = "interval";
  const Dataset data = load_dataset({"cell b.csv", "cell a.csv"}, options);
  EXPECT_THAT(data.experiments,
              ElementsAre("cell a 1", "cell a 2", "cell b 1", "cell b 2", "cell b 3"));
  EXPECT_THAT(by_test(data, "interval"), ElementsAre(1, 2, 1, 2, 3));
  EXPECT_THAT(data.recording, ElementsAre(0, 0, 1, 1, 1));
  EXPECT_THAT(data.find("recording")->levels, ElementsAre("cell a", "cell b"));
  EXPECT_EQ(data.find("recording")->role, data::Role::test) << "no cause of friction";
  EXPECT_THAT(data.notes, Contains(HasSubstr("5 tests are intervals of 2 recordings (intervals of "
                                             "one file), up to 3 of one")));
}

TEST_F(Recordings, OfIntervalsTakeTheRowOfTheirFileFromTheTableOfTests) {
  file("pack21.csv", intervals(3, 0.3));
  file("pack22.csv", intervals(2, 0.3));
  options.experiment = "interval";
  options.tests = file("packs.csv", "experiment,oil_mg\n21,0.5\n22,0.9\n");
  const Dataset data = load_dataset({"pack21.csv", "pack22.csv"}, options);
  EXPECT_THAT(by_test(data, "oil_mg"), ElementsAre(0.5, 0.5, 0.5, 0.9, 0.9));
  EXPECT_THAT(data.notes, Contains(HasSubstr("a row holds for all intervals of its file")));
  EXPECT_TRUE(data.unused.empty());
  options.tests = file("packs.csv", "experiment,oil_mg\n21,0.5\npack22 1,0.9\npack22 2,1.5\n");
  EXPECT_THAT(by_test(load_dataset({"pack21.csv", "pack22.csv"}, options), "oil_mg"),
              ElementsAre(0.5, 0.5, 0.5, 0.9, 1.5))
      << "a row of an interval's own goes first";
  file("old21.csv", intervals(1, 0.3));
  file("new21.csv", intervals(1, 0.3));
  options.tests = file("packs.csv", "experiment,oil_mg\n21,0.5\n");
  try {
    load_dataset({"old21.csv", "new21.csv"}, options);
    ADD_FAILURE() << "two files took one row";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("would both be '21' of this table"));
  }
}

TEST_F(Recordings, AreTestsOfTheirOwnWhereTheJobSaysSo) {
  file("a.csv", intervals(3, 0.3));
  options.experiment = "interval";
  options.recording = "none";
  const Dataset data = load_dataset({"a.csv"}, options);
  EXPECT_TRUE(data.recording.empty());
  EXPECT_FALSE(data.has("interval"));
}

TEST_F(Recordings, GoOnByTheirClockWhereAColumnCutsThem) {
  std::string text = "step,";
  text += header;
  for (const auto& [step, start] : {std::pair(7, 20.0), std::pair(3, 0.0), std::pair(5, 10.0)}) {
    std::string rows = rows_from(start, 0.3);
    for (std::size_t at = 0; at < rows.size(); at = rows.find('\n', at) + 1)
      rows.insert(at, fmt::format("{},", step));
    text += rows;
  }
  file("a.csv", text);
  options.experiment = "step";
  const Dataset data = load_dataset({"a.csv"}, options);
  EXPECT_THAT(data.experiments, ElementsAre("3", "5", "7"));
  EXPECT_THAT(by_test(data, "interval"), ElementsAre(1, 2, 3)) << "in order of time";
  EXPECT_THAT(data.recording, ElementsAre(0, 0, 0));
}

TEST_F(Recordings, AreNotFoundWhereEachTestStartsItsOwnClock) {
  for (int i = 1; i <= 8; ++i)
    file(fmt::format("run_{}.csv", i), header + rows_from(0, 0.3, static_cast<unsigned>(i)));
  const Dataset data = load_dataset({"*.csv"}, options);
  EXPECT_TRUE(data.recording.empty());
  EXPECT_THAT(data.notes, Not(Contains(HasSubstr("recording"))));
}

TEST_F(Recordings, OfSeveralFilesGoOnFromNumberToNumber) {
  for (int i = 1; i <= 12; ++i)
    file(fmt::format("step_{}.csv", i), header + rows_from(10 * i, 0.3, 3));
  const Dataset data = load_dataset({"*.csv"}, options);
  EXPECT_EQ(data.experiments[1], "step_2") << "not step_10";
  ASSERT_EQ(data.recording.size(), 12U);
  EXPECT_THAT(data.recording, Each(0));
  EXPECT_EQ(first_of(data, "interval", 9), 10);
}

TEST_F(Recordings, AreAskedForWhereFrictionAloneFollowsTheNumber) {
  const auto write = [&](double drift) {
    for (int i = 1; i <= 16; ++i)
      file(fmt::format("{:03}.csv", i),
           header + rows_from(0, 0.3 + drift * i, static_cast<unsigned>(i)));
  };
  write(0.005);
  Dataset data = load_dataset({"*.csv"}, options);
  EXPECT_TRUE(data.recording.empty()) << "asked, not decided";
  EXPECT_THAT(data.notes,
              Contains(HasSubstr("001 to 016: are these 16 tests intervals of one recording?")));
  options.recording = "name";
  data = load_dataset({"*.csv"}, options);
  EXPECT_THAT(data.recording, Each(0));
  EXPECT_THAT(data.notes, Not(Contains(HasSubstr("are these"))));
  options.recording = "";
  write(0);
  EXPECT_THAT(load_dataset({"*.csv"}, options).notes, Not(Contains(HasSubstr("are these"))));
  for (int i = 1; i <= 16; ++i) // sorted by what was set: the course is that of the design
    file(fmt::format("{:03}.csv", i), header + rows_from(0, 0.3 + 0.005 * i, 1, 5 + i));
  EXPECT_THAT(load_dataset({"*.csv"}, options).notes, Not(Contains(HasSubstr("are these"))));
}

TEST_F(Recordings, AreSaidByAColumnOrByTheGroupOfAName) {
  for (const char* name : {"m1_s1", "m1_s2", "m2_s1", "m2_s2"})
    file(std::string(name) + ".csv", header + rows_from(0, 0.3));
  options.files.emplace_back();
  options.files[0].match = "*";
  options.files[0].from_name = R"((?<recording>m\d)_)";
  EXPECT_THAT(load_dataset({"*.csv"}, options).recording, ElementsAre(0, 0, 1, 1));
  options.files[0].from_name = R"((?<part>m\d)_s(?<step>\d))";
  EXPECT_TRUE(load_dataset({"*.csv"}, options).recording.empty());
  options.recording = "part";
  EXPECT_THAT(load_dataset({"*.csv"}, options).recording, ElementsAre(0, 0, 1, 1));
  options.recording = "prat";
  EXPECT_THAT(fault_of({"*.csv"}), HasSubstr("there is no column 'prat' (data.recording)"));
  options.recording = "F_R_N";
  EXPECT_THAT(fault_of({"*.csv"}), HasSubstr("F_R_N is not the same in all rows of a test"));
}

TEST_F(Recordings, AreFilesWithOneNameOfATest) {
  const auto loops = [&](const char* column) {
    for (int i = 0; i < 6; ++i)
      file(fmt::format("loop{}.csv", i),
           fmt::format("{}: T{}\n", column, i / 3) + header + rows_from(0, 0.3));
    options.above = {column};
    return load_dataset({"loop*.csv"}, options).recording;
  };
  EXPECT_THAT(loops("Test Name"), ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(loops("Oil"), testing::IsEmpty());
}

// ---- each row a test ----

const std::string design = "load,distance,filler,F_R_N,F_N_N,sigma_n_MPa\n";
std::string design_rows() {
  std::string text = design;
  for (int i = 0; i < 27; ++i)
    text += fmt::format("{},{},{},{:.3f},10,{}\n", 10 * (1 + i / 9), 100 * (1 + i / 3 % 3),
                        1 + i % 3, 1 + 0.01 * i, 5 + i / 9);
  return text;
}

TEST_F(Recordings, RowsThatAreTestsAreAskedForAndRead) {
  EXPECT_THAT(fault(design_rows()), HasSubstr("is each of these 27 rows a test?"));
  EXPECT_THAT(fault(design_rows()), HasSubstr("data.experiment = \"row\""));
  options.experiment = "file";
  EXPECT_EQ(read(design_rows()).experiments.size(), 1U);
  options.experiment = "row";
  const Dataset data = read(design_rows());
  ASSERT_EQ(data.experiments.size(), 27U);
  EXPECT_EQ(data.experiments[9], "a 10");
  EXPECT_EQ(data.rows(), 27U);
  EXPECT_TRUE(data.recording.empty());
}

TEST_F(Recordings, RowsOfOneCourseAreNotTakenForTests) {
  std::string steps = "gear,load,F_R_N,F_N_N,sigma_n_MPa\n",
              turns = "way,mate,F_R_N,F_N_N,sigma_n_MPa\n";
  for (int i = 0; i < 60; ++i) {
    steps += fmt::format("{},{},{},10,{}\n", 1 + i / 20, 1 + i / 10 % 3, 1 + 0.01 * i, 5 + i / 30);
    turns += fmt::format("{},steel,{},10,5\n", i % 2 ? 1 : -1, 1 + 0.01 * i);
  }
  EXPECT_EQ(read(steps).experiments.size(), 1U);
  EXPECT_EQ(read(turns).experiments.size(), 1U);
}

// ---- kept together ----

// Recordings of 1 to 5 tests with different rows.
Dataset campaign(std::size_t recordings, std::uint64_t seed) {
  Dataset data;
  data.columns = {{"sigma_n_MPa", "MPa", {}, {}}, {"tau_R_MPa", "MPa", {}, {}}};
  Random random(seed, 1);
  for (std::size_t r = 0; r < recordings; ++r)
    for (std::size_t i = 0; i <= random.below(5); ++i) {
      const double mu = 0.1 + 0.01 * random.normal();
      for (int row = 0; row < 6; ++row) {
        data.columns[0].values.push_back(100 + 10 * random.uniform());
        data.columns[1].values.push_back(data.columns[0].values.back() * mu);
      }
      data.experiments.push_back(fmt::format("r{} {}", r, i));
      data.first_row.push_back(data.columns[0].values.size());
      data.recording.push_back(r);
    }
  return data;
}

bool shares_recording(const Dataset& a, const Dataset& b) {
  const std::set<std::size_t> known(a.recording.begin(), a.recording.end());
  return std::any_of(b.recording.begin(), b.recording.end(),
                     [&](std::size_t r) { return known.count(r) > 0; });
}

TEST(KeptTogether, NoRecordingIsOnBothSidesOfAnyDraw) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Dataset data = campaign(2 + seed % 13, seed);
    const data::Units units = data::units_of(data);
    const data::Split split = data::hold_out(data, 0.25, seed);
    EXPECT_FALSE(shares_recording(split.training, split.validation));
    EXPECT_EQ(split.training.experiments.size() + split.validation.experiments.size(),
              data.experiments.size());
    const auto parts_are_apart = [&](const std::vector<std::size_t>& fold) {
      for (std::size_t f = 0; f <= *std::max_element(fold.begin(), fold.end()); ++f) {
        std::vector<std::size_t> in, out;
        for (std::size_t e = 0; e < fold.size(); ++e)
          (fold[e] == f ? out : in).push_back(e);
        ASSERT_FALSE(out.empty());
        EXPECT_FALSE(shares_recording(data.subset(in), data.subset(out)));
      }
    };
    parts_are_apart(
        calibrate::experiment_folds(units, std::min<std::size_t>(5, units.count), seed, 0));
    parts_are_apart(calibrate::delivery_folds(data, seed));
    for (std::size_t e = 0; e < data.experiments.size(); ++e) {
      const Dataset others = calibrate::without_kin(data, e);
      EXPECT_EQ(std::count(others.recording.begin(), others.recording.end(), data.recording[e]), 0);
    }
  }
}

TEST(KeptTogether, IntervalsOfTheOnlyRecordingAreTests) {
  Dataset data = campaign(9, 1);
  std::fill(data.recording.begin(), data.recording.end(), 4);
  EXPECT_EQ(data::units_of(data).count, data.experiments.size());
  EXPECT_EQ(data::hold_out(data, 0.25, 1).validation.experiments.size(),
            (data.experiments.size() + 2) / 4);
}

TEST(KeptTogether, IntervalsOfErrorsDrawRecordings) {
  // 12 recordings of 8 alike tests: as 12 tests, not as 96.
  std::vector<stats::ErrorSums> tests, recordings;
  Random random(3, 3);
  for (std::size_t r = 0; r < 12; ++r) {
    const double error = std::abs(random.normal());
    for (int i = 0; i < 8; ++i)
      tests.push_back({10 * error, 10 * error * error, 10 * error, 10, r});
    recordings.push_back({80 * error, 80 * error * error, 80 * error, 80});
  }
  const auto together = calibrate::metrics(tests, 500, 1);
  const auto whole = calibrate::metrics(recordings, 500, 1);
  EXPECT_NEAR(together.mae_interval.low, whole.mae_interval.low, 1e-12);
  EXPECT_NEAR(together.mae_interval.high, whole.mae_interval.high, 1e-12);
  EXPECT_EQ(together.n_experiments, 96U);
  for (stats::ErrorSums& one : tests)
    one.recording = stats::no_recording;
  const auto alone = calibrate::metrics(tests, 500, 1);
  EXPECT_LT(alone.mae_interval.high - alone.mae_interval.low,
            0.6 * (whole.mae_interval.high - whole.mae_interval.low));
}

// ---- how tests were filed ----

std::set<std::string> names_of(const Dataset& data) {
  return {data.experiments.begin(), data.experiments.end()};
}

TEST(Filing, TheHoldOutIsDrawnByContent) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Dataset data = campaign(25, seed);
    std::vector<std::size_t> order(data.experiments.size());
    std::iota(order.begin(), order.end(), 0);
    Random(seed, 7).shuffle(std::span(order));
    Dataset shuffled = data.subset(order), alone = shuffled, before = data;
    const data::Split split = data::hold_out(data, 0.25, seed);
    EXPECT_EQ(names_of(data::hold_out(shuffled, 0.25, seed).validation),
              names_of(split.validation));
    std::reverse(shuffled.columns.begin(), shuffled.columns.end());
    EXPECT_EQ(names_of(data::hold_out(shuffled, 0.25, seed).validation),
              names_of(split.validation));
    alone.recording.clear();
    before.recording.clear();
    EXPECT_EQ(names_of(data::hold_out(alone, 0.25, seed).validation),
              names_of(data::hold_out(before, 0.25, seed).validation));
  }
}

TEST(Filing, TheHoldOutIsADrawOfItsShare) {
  std::vector<std::size_t> held(40, 0); // of 400 seeds
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    Dataset data = campaign(40, 5);
    data.recording.clear();
    data = data.subset(std::vector<std::size_t>{
        0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18, 19,
        20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39});
    const std::set<std::string> out = names_of(data::hold_out(data, 0.25, seed).validation);
    EXPECT_EQ(out.size(), 10U);
    for (std::size_t e = 0; e < 40; ++e)
      held[e] += out.count(data.experiments[e]);
  }
  const auto [least, most] = std::minmax_element(held.begin(), held.end());
  EXPECT_GT(*least, 65U) << "100 +- 8.7 of each";
  EXPECT_LT(*most, 135U);
}

TEST_F(Recordings, OrderOfFilesAndOfTestsInThemChangesNothing) {
  std::vector<std::string> tests;
  for (int i = 0; i < 12; ++i) {
    std::string rows = rows_from(0, 0.3 + 0.01 * i, static_cast<unsigned>(i));
    for (std::size_t at = 0; at < rows.size(); at = rows.find('\n', at) + 1)
      rows.insert(at, fmt::format("t{},", i));
    tests.push_back(rows);
  }
  const auto write = [&](const char* name, std::initializer_list<int> which) {
    std::string text = "experiment," + header;
    for (const int i : which)
      text += tests[static_cast<std::size_t>(i)];
    file(name, text);
  };
  write("a.csv", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  write("b.csv", {7, 2, 11, 5, 0});
  write("c.csv", {10, 9, 1, 8, 3, 6, 4});
  const Dataset one = load_dataset({"a.csv"}, options);
  EXPECT_EQ(load_dataset({"b.csv", "c.csv"}, options).hash, one.hash);
  EXPECT_EQ(load_dataset({"c.csv", "b.csv"}, options).hash, one.hash);
}

TEST(Filing, NamesAreSortedByTheirNumbers) {
  const std::vector<std::string> sorted = {"a", "a1", "a2", "a10", "a10b", "b01", "b1", "b2"};
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = 0; j < sorted.size(); ++j)
      EXPECT_EQ(natural_less(sorted[i], sorted[j]), i < j) << sorted[i] << " " << sorted[j];
}

// ---- repeats ----

// 12 tests at two pressures, six alike at each.
Dataset repeats() {
  Dataset data;
  data.columns = {
      {"sigma_n_MPa", "MPa", {}, {}}, {"v_rel_mm_s", "mm/s", {}, {}}, {"tau_R_MPa", "MPa", {}, {}}};
  for (std::size_t e = 0; e < 12; ++e) {
    for (int i = 0; i < 10; ++i) {
      data.columns[0].values.push_back(e % 2 ? 100 : 200);
      data.columns[1].values.push_back(1 + i);
      data.columns[2].values.push_back(10);
    }
    data.experiments.push_back(fmt::format("t{}", e));
    data.first_row.push_back(data.first_row.back() + 10);
  }
  return data;
}
void add_setting(Dataset& data, const std::string& name, const std::vector<double>& of_tests,
                 std::vector<std::string> levels = {}) {
  data::Column column{name, "", {}, std::move(levels)};
  for (const double value : of_tests)
    column.values.insert(column.values.end(), 10, value);
  data.columns.push_back(std::move(column));
}
std::size_t tests_in_groups(const Dataset& data) {
  std::size_t tests = 0;
  for (const auto& group : calibrate::replicate_groups(data))
    tests += group.size();
  return tests;
}

TEST(Repeats, AgreeInEveryLabelAndSetting) {
  Dataset data = repeats();
  EXPECT_EQ(calibrate::replicate_groups(data).size(), 2U);
  std::vector<double> unlike(12);
  std::iota(unlike.begin(), unlike.end(), 0);
  std::vector<std::string> materials = {"POM",   "PEEK", "PA6", "PTFE", "steel", "brass",
                                        "glass", "wood", "PVC", "ABS",  "tin",   "zinc"};
  std::sort(materials.begin(), materials.end());
  add_setting(data, "material", unlike, materials);
  EXPECT_EQ(tests_in_groups(data), 0U) << "a label of many levels";
  data.columns.back().role = data::Role::ignore;
  EXPECT_EQ(tests_in_groups(data), 12U);
  data.columns.back().why = data::many_texts; // too many to be searched
  EXPECT_EQ(tests_in_groups(data), 0U);
  data = repeats();
  add_setting(data, "tool", {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2});
  EXPECT_EQ(tests_in_groups(data), 11U);
}

TEST(Repeats, AreNotPartedByWhatCountsThem) {
  Dataset data = repeats();
  std::vector<double> number(12);
  std::iota(number.begin(), number.end(), 1);
  add_setting(data, "No", number);
  std::vector<std::string> specimens;
  for (int i = 1; i <= 12; ++i)
    specimens.push_back(fmt::format("S{:02}", i));
  std::iota(number.begin(), number.end(), 0);
  add_setting(data, "specimen", number, specimens);
  EXPECT_EQ(tests_in_groups(data), 12U);
}

TEST(Repeats, MayDifferInAReadingByItsResolution) {
  Dataset data = repeats();
  add_setting(data, "humidity_pct",
              {40.2, 40.4, 40.3, 40.5, 61.3, 61.1, 61.2, 61, 80, 79.9, 20.5, 20.6});
  const auto groups = calibrate::replicate_groups(data);
  EXPECT_EQ(tests_in_groups(data), 8U);
  for (const auto& group : groups)
    for (const std::size_t e : group)
      EXPECT_NEAR(first_of(data, "humidity_pct", e), first_of(data, "humidity_pct", group[0]),
                  0.61);
}

TEST(Repeats, DifferByADirectionWithinTheTest) {
  Dataset data = repeats();
  data::Column direction{"direction", "", {}, {}};
  for (std::size_t e = 0; e < 12; ++e)
    for (int i = 0; i < 10; ++i)
      direction.values.push_back(e < 6 || i < 5 ? 1 : -1);
  data.columns.push_back(direction);
  const auto groups = calibrate::replicate_groups(data);
  ASSERT_EQ(groups.size(), 4U);
  for (const auto& group : groups)
    EXPECT_EQ(group.front() < 6, group.back() < 6);
}

TEST(Repeats, AreNeverIntervalsOfOneRecording) {
  Dataset data = repeats();
  for (std::size_t e = 0; e < 12; ++e)
    data.recording.push_back(e / 4);
  for (const auto& group : calibrate::replicate_groups(data)) {
    std::set<std::size_t> recordings;
    for (const std::size_t e : group)
      EXPECT_TRUE(recordings.insert(data.recording[e]).second);
  }
}

} // namespace
} // namespace frictab::recordings_test
