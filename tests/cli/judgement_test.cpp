// What a run says about its laws beside their ranking: comparison, noise floor, conditional use.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"

namespace frictab::judgement_test {
namespace {

using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;

struct Judgement : testing::Test {
  // A small synthetic campaign, its job.toml and what `calibrate` says.
  std::string calibrate(std::vector<std::string> twin_options, std::vector<std::string> settings) {
    std::vector<std::string> twin = {"twin", directory.path("data"), "--seed", "3", "--design",
                                     design};
    twin.insert(twin.end(), twin_options.begin(), twin_options.end());
    const auto made = run_frictab(twin);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    std::vector<std::string> arguments = {"calibrate", directory.path("data/job.toml")};
    for (const std::string& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    const auto result = run_frictab(arguments);
    exit_code = result.exit_code;
    error = result.err;
    return result.out;
  }
  nlohmann::ordered_json calibration() const {
    return test::parse_json(directory.read("data/out/calibration.json"));
  }
  std::string design = "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=100;validation=12";
  const std::string two_laws = "models.use=[\"log_coulomb\", \"coulomb_0.04\"]";
  const TemporaryDirectory directory;
  int exit_code = -1;
  std::string error;
};

TEST_F(Judgement, SummaryHoldsTheFloorOfTheOracleAndWhoIsBest) {
  const std::string out = calibrate({"--oracle"}, {two_laws});
  ASSERT_EQ(exit_code, 0) << error;
  EXPECT_THAT(directory.read("data/job.toml"),
              HasSubstr("oracle = [\"training_oracle.csv\", \"validation_oracle.csv\"]"));
  EXPECT_THAT(out, testing::ContainsRegex(
                       "  noise floor +[0-9.]+ +[0-9.]+ to [0-9.]+ +[0-9.]+ +the twin's own "
                       "truth, synthetic data only\n"
                       "  Pair by pair, log_coulomb is significantly better than 1 of 1 other law "
                       "\\(95 % per pair, paired by experiment\\)\\.\n  Not ruled out as best "
                       "\\(95 %, 2 laws compared together\\): 1 of 2 \\(log_coulomb\\)\\.\n"));
  const auto floor = calibration().at("noise_floor");
  EXPECT_EQ(floor.at("method"), "oracle");
  EXPECT_EQ(floor.at("part"), "validation");
  EXPECT_EQ(floor.at("synthetic_only"), true);
  const auto twin = test::parse_json(directory.read("data/twin.json"));
  EXPECT_NEAR(floor.at("mae_MPa").get<double>(),
              twin.at("validation").at("errors").at("oracle").at("mae_MPa").get<double>(), 1e-9);
  EXPECT_EQ(calibration().at("validation_experiments").size(), 12U);
  EXPECT_THAT(directory.read("data/out/benchmark.md"),
              HasSubstr("\nValidation experiments: " +
                        calibration().at("validation_experiments").at(0).get<std::string>() +
                        ", "));
  const auto pair = calibration().at("comparisons").at("pairs").at(0);
  EXPECT_EQ(pair.at("law"), "log_coulomb");
  EXPECT_EQ(pair.at("verdict"), "better");
}

// A fine constant of the literature stands first, and is no result of these tests.
TEST_F(Judgement, ConstantsOfTheLiteratureCompeteOnlyWhereTheJobNamesThem) {
  std::string rows = "experiment,sigma_n_MPa,tau_R_MPa\n";
  for (int t = 0; t < 8; ++t)
    for (int i = 0; i < 6; ++i) {
      const double sigma = 500 + 100 * t, tau = 0.08 * sigma * (1 + 0.02 * (t % 2 == 0 ? 1 : -1));
      rows += fmt::format("t{},{},{}\n", t, sigma, tau * (1 + 0.01 * (i % 3 - 1)));
    }
  directory.write("d.csv", rows);
  directory.write("job.toml", "[data]\ntraining = \"d.csv\"\n");
  const auto names_of = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"calibrate", directory.path("job.toml")});
    const auto result = run_frictab(more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  };
  const std::string out = names_of({});
  EXPECT_THAT(out, testing::ContainsRegex(
                       "\n +[0-9]+  coulomb_0.08 \\(reference, not a candidate\\) .* mu = 0.08\n"));
  auto written = test::parse_json(directory.read("out/calibration.json"));
  ASSERT_EQ(written.at("models").at(0).at("name"), "coulomb_0.08") << "it has the least error";
  EXPECT_EQ(written.at("models").at(0).at("candidate"), false);
  EXPECT_THAT(written.at("best").get<std::string>(), testing::StartsWith("coulomb"));
  EXPECT_NE(written.at("best"), "coulomb_0.08");
  EXPECT_NE(written.at("recommended"), "coulomb_0.08");
  EXPECT_NE(written.at("choice").at("law"), "coulomb_0.08");
  for (const auto& law : written.at("comparisons").at("best_of_all"))
    if (law.at("name") == "coulomb_0.08") {
      EXPECT_EQ(law.at("may_be_best"), false);
      EXPECT_TRUE(law.at("p_value").is_null());
    }
  EXPECT_THAT(directory.read("out/benchmark.md"), HasSubstr("coulomb_0.08 (reference, not a "));
  names_of({"--set", "models.use=[\"coulomb\", \"coulomb_0.08\"]"});
  written = test::parse_json(directory.read("out/calibration.json"));
  EXPECT_EQ(written.at("best"), "coulomb_0.08") << "the job names it";
  EXPECT_EQ(written.at("recommended"), "coulomb_0.08") << "nothing was fitted for it";
}

// Twelve tests do not tell a polynomial of many terms from a law of few parameters.
TEST_F(Judgement, RecommendsTheSimplestLawThatIsNotWorseAndTabulatesIt) {
  calibrate({}, {"models.use=[\"coulomb\", \"exp_coulomb\", \"log_coulomb\", \"polynomial\"]"});
  ASSERT_EQ(exit_code, 0) << error;
  const auto written = calibration();
  const auto by_name = [&](const std::string& name) {
    for (const auto& model : written.at("models"))
      if (model.at("name") == name) return model;
    return nlohmann::ordered_json();
  };
  const auto& said = written.at("recommendation");
  const std::string name = said.at("law");
  EXPECT_EQ(written.at("recommended"), name);
  EXPECT_EQ(written.at("best"), said.at("best"));
  EXPECT_NEAR(said.at("behind_MPa").get<double>(),
              by_name(name).at("validation").at("mae_MPa").get<double>() -
                  by_name(said.at("best")).at("validation").at("mae_MPa").get<double>(),
              1e-9);
  EXPECT_LE(said.at("behind_MPa").get<double>(), said.at("std_error_MPa").get<double>() + 1e-12);
  EXPECT_THAT(directory.read("data/out/benchmark.md"), HasSubstr("Recommended: " + name));
  const auto tabulated = run_frictab({"tabulate", directory.path("data/job.toml"), "--set",
                                      "table.model=[\"recommended\", \"best\"]", "--set",
                                      "models.use=[\"coulomb\", \"exp_coulomb\", "
                                      "\"log_coulomb\", \"polynomial\"]"});
  EXPECT_EQ(tabulated.exit_code, 0) << tabulated.err;
  EXPECT_FALSE(directory.read("data/out/tables/" + name + ".h5").empty());
  EXPECT_FALSE(
      directory.read("data/out/tables/" + said.at("best").get<std::string>() + ".h5").empty());
}

TEST_F(Judgement, WithoutOracleAndRepeatsSaysWhatWouldGiveTheFloor) {
  const std::string out = calibrate({}, {two_laws});
  EXPECT_THAT(out, testing::ContainsRegex("  noise floor +> [0-9.]+ .*scatter within experiments "
                                          "only, .*\n  Noise floor known as a lower bound only: "
                                          "repeat any one test twice, unchanged\\.\n"));
  EXPECT_EQ(calibration().at("noise_floor").at("lower_bound"), true);
  EXPECT_THAT(directory.read("data/out/benchmark.md"), HasSubstr("\n|  | noise floor | \\> "));
}

TEST_F(Judgement, RepeatedTestsGiveTheFloorOfTheirPart) {
  design = "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=6;replicates=3";
  const std::string out = calibrate({"--no-bystanders"}, {two_laws});
  EXPECT_THAT(out, HasSubstr("48 repeated tests in 16 groups (8.26 MPa, more than the best law "
                             "errs)\n"));
  EXPECT_THAT(out, Not(HasSubstr("to know it")));
}

TEST_F(Judgement, MeasuredDataHaveNoOracle) {
  calibrate({"--oracle"}, {two_laws});
  directory.write("data/training.csv",
                  replace_all(directory.read("data/training.csv"), ",origin\n", ",source\n"));
  const std::string job =
      directory.write("data/measured.toml", "[data]\ntraining = \"training.csv\"\n"
                                            "oracle = \"training_oracle.csv\"\n");
  const auto result = run_frictab({"calibrate", job});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, job + ":3:10: error: data.oracle is for synthetic data: measured data have "
                              "no known truth\n  hint: synthetic data say so in a column `origin`; "
                              "for measured data, repeated tests give the noise floor\n");
}

TEST_F(Judgement, OfFewTestsEachIsLeftOutInTurnAndTheTextSaysSo) {
  design = "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=0";
  const std::string out = calibrate({"--no-bystanders"}, {two_laws});
  ASSERT_EQ(exit_code, 0) << error;
  EXPECT_THAT(out,
              testing::StartsWith("Data:\n  640 rows of 16 experiments, each experiment judged by "
                                  "laws fitted without it - SYNTHETIC data\n"));
  EXPECT_THAT(out, HasSubstr("  Of 1,000 resamples of the tests 100 % choose log_coulomb.\n"));
  const auto json = calibration();
  EXPECT_EQ(json.at("judged_by"), "leave_one_out");
  EXPECT_EQ(json.at("validation_experiments").size(), 16U);
  EXPECT_EQ(json.at("models").at(0).at("validation").at("n_experiments"), 16);
  EXPECT_EQ(json.at("models").at(0).at("by_experiment_left_out").at("mae_MPa").size(), 16U);
  EXPECT_THAT(
      directory.read("data/out/benchmark.md"),
      HasSubstr("Calibrated on 640 rows of 16 experiments, each left out in turn and predicted by "
                "the law fitted to all the others. "));
  EXPECT_THAT(directory.read("data/out/errors_by_experiment.csv"),
              Not(HasSubstr("log_coulomb,E001,0,")));
}

TEST_F(Judgement, OfTwoTestsThatJudgeEachOtherThereAreNoIntervals) {
  design = "p=1725;psi=1,20;v=50;T=110;points=100;validation=0";
  const std::string out = calibrate({"--no-bystanders"}, {two_laws});
  ASSERT_EQ(exit_code, 0) << error;
  EXPECT_THAT(out, HasSubstr("fitted without it (their two errors say one difference twice: no "
                             "intervals, no comparison) - SYNTHETIC data\n"));
  EXPECT_THAT(out, testing::ContainsRegex("\n  1  log_coulomb +[0-9.]+ +- "));
  EXPECT_TRUE(calibration().at("comparisons").at("pairs").empty());
}

TEST_F(Judgement, OfOneTestErrorsAreOfTheFitAndEveryTextSaysSo) {
  design = "p=1865;psi=4.47;v=50;T=110;points=400;validation=0";
  const std::string out = calibrate({"--no-bystanders", "--profile", "varied"}, {two_laws});
  ASSERT_EQ(exit_code, 0) << error;
  EXPECT_THAT(
      out,
      testing::StartsWith(
          "Data:\n  400 rows of 1 experiment, no other to judge the laws by - SYNTHETIC data\n"
          "  If they are of several tests, data.experiment names the column that distinguishes "
          "them.\n\n"
          "Laws by mean absolute error on the ONE experiment they are fitted to; no other was "
          "seen (tau_R, MPa):\n"));
  EXPECT_THAT(out, Not(HasSubstr("expected error of")));
  const auto json = calibration();
  EXPECT_EQ(json.at("judged_by"), "fit");
  const auto best = json.at("models").at(0);
  EXPECT_EQ(best.at("validation").at("mae_MPa"), best.at("training").at("mae_MPa"));
  EXPECT_TRUE(best.at("validation").at("mae_95").at(0).is_null()) << "one test has no interval";
  EXPECT_THAT(directory.read("data/out/benchmark.md"),
              HasSubstr("not validated: 400 rows of 1 experiment, to which the laws are fitted"));
  EXPECT_THAT(directory.read("data/out/errors_by_experiment.csv"),
              HasSubstr("log_coulomb,E001,0,"));
  const auto run = run_frictab({"run", directory.path("data/job.toml"), "--set", two_laws});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("no effect that so few tests can prove"));
  const std::string report = directory.read("data/out/report.html");
  EXPECT_THAT(report, HasSubstr(" on the test that it is fitted to</li>"));
  EXPECT_THAT(report, Not(HasSubstr("left out in turn")));
}

TEST_F(Judgement, OneTestIsNotDividedWhereTheJobAsksForAShare) {
  design = "p=1865;psi=4.47;v=50;T=110;points=40;validation=0";
  calibrate({"--no-bystanders"}, {two_laws, "data.holdout=0.25"});
  EXPECT_EQ(exit_code, 2);
  EXPECT_THAT(error, HasSubstr("there is only one experiment: none can be held out to validate"));
}

TEST_F(Judgement, OfFewTestsAShareIsHeldOutWhereTheJobSaysSo) {
  design = "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=0";
  const std::string out = calibrate({"--no-bystanders"}, {two_laws, "data.holdout=0.25"});
  EXPECT_THAT(out, HasSubstr("480 rows of 12 experiments to train, 160 rows of 4 experiments to "
                             "validate"));
  EXPECT_THAT(out, HasSubstr("  Of 1,000 other splits of all tests 100 % choose log_coulomb.\n"));
  const auto json = calibration();
  EXPECT_EQ(json.at("judged_by"), "held_out");
  EXPECT_TRUE(json.at("models").at(0).at("by_experiment_left_out").is_null());
  EXPECT_THAT(directory.read("data/out/benchmark.md"), HasSubstr(", held out by seed 3. "));
}

TEST_F(Judgement, WhatToTakeAndExpectIsDecidedOverAllTestsWhereFewAreHeldOut) {
  design = "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=0";
  const std::string out = calibrate({"--no-bystanders"}, {two_laws, "data.holdout=0.25"});
  const auto json = calibration();
  EXPECT_EQ(json.at("experiments_left_out_in_turn").size(), 16u);
  EXPECT_EQ(json.at("recommendation").at("tests_left_out_in_turn"), 16);
  double rows = 0, sum = 0;
  for (const auto& model : json.at("models")) {
    if (model.at("name") != json.at("recommended")) continue;
    const auto& errors = model.at("by_experiment_left_out_in_turn");
    ASSERT_EQ(errors.at("mae_MPa").size(), 16u);
    for (std::size_t e = 0; e < 16; ++e) {
      rows += errors.at("n_rows").at(e).get<double>();
      sum += errors.at("n_rows").at(e).get<double>() * errors.at("mae_MPa").at(e).get<double>();
    }
  }
  EXPECT_EQ(rows, 640);
  EXPECT_NEAR(json.at("recommendation").at("expected_mae_MPa").get<double>(), sum / rows,
              0.02 * sum / rows);
  EXPECT_THAT(out, testing::ContainsRegex("On new tests log_coulomb is expected to err by [0-9.]+ "
                                          "MPa, by all 16 tests left out in turn; the [0-9.]+ MPa "
                                          "above are of the 4 held out, which are few\\."));
}

TEST_F(Judgement, ConditionalUseStandsApartFromTheRanking) {
  const std::string out = calibrate({}, {two_laws, "calibration.condition_on_mm=2"});
  ASSERT_EQ(exit_code, 0) << error;
  EXPECT_THAT(out, HasSubstr("\nConditional use: part of every test predicts its rest\n  Not to be "
                             "compared with the ranking."));
  const auto j = calibration();
  EXPECT_EQ(j.at("models").size(), 2u);
  EXPECT_EQ(j.at("conditional").at("models").size(), 2u);
  EXPECT_EQ(j.at("conditional").at("condition_on_mm"), 2);
  const std::string page = directory.read("data/out/benchmark.md");
  EXPECT_THAT(page,
              HasSubstr("## Conditional use: part of every test predicts its rest\n\n**Not to "
                        "be compared with the ranking.**"));
  EXPECT_GT(page.find("## Conditional use"), page.find("## Published figures"));
}

TEST_F(Judgement, ConditionBeyondTheDataIsAFaultOfTheJob) {
  calibrate({}, {two_laws, "calibration.condition_on_mm=200"});
  EXPECT_EQ(exit_code, 2);
  EXPECT_THAT(error, HasSubstr("calibration.condition_on_mm = 200 leaves no row of the training "
                               "data to be judged on: the longest sliding distance is 19.8 mm"));
}

TEST(ExplainJob, DocumentsConditionalUseAndTheOracle) {
  const auto result = run_frictab({"explain", "calibration.condition_on_mm"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("never ranked"));
  EXPECT_THAT(run_frictab({"explain", "data.oracle"}).out, HasSubstr("SYNTHETIC data only"));
}

} // namespace
} // namespace frictab::judgement_test
