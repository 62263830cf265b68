// A law of the job file goes the whole way: calibrated, tabulated, exported, verified, read back.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "support/run_command.h"

namespace frictab::own_law_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;

class SlowOwnLaw : public testing::Test {
protected:
  void SetUp() override { // SYNTHETIC: 40 tests of 12 rows, made by the Orowan law
    ASSERT_EQ(
        run_frictab({"twin", directory.path("data"), "--law", "orowan", "--seed", "4", "--design",
                     "p=600,1200,2400;psi=1,4;v=5,50;T=20,100;points=12;validation=8"})
            .exit_code,
        0);
  }
  void write_job(const std::string& laws) {
    directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                                "validation = \"data/validation.csv\"\n" +
                                    laws);
  }
  CommandResult frictab(const std::vector<std::string>& words) {
    return run_frictab(words, directory.path());
  }
  nlohmann::json fit(const std::string& law) {
    const auto file = nlohmann::json::parse(directory.read("out/calibration.json"));
    for (const auto& one : file.at("models"))
      if (one.at("name") == law) return one;
    return {};
  }
  TemporaryDirectory directory;
};

TEST_F(SlowOwnLaw, WrittenLikeARegisteredOneHasItsParametersAndErrors) {
  write_job("[models]\nuse = [\"orowan\", \"mine\"]\n[models.mine]\n"
            "formula = \"min(mu*sigma_n_MPa, m*k_MPa)\"\n"
            "parameters = { mu = { range = [0, 1] }, m = { range = [0, 1] } }\n");
  const CommandResult result = frictab({"calibrate", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto mine = fit("mine"), orowan = fit("orowan");
  for (const int p : {0, 1}) {
    const double a = mine.at("parameters")[p].at("value"),
                 b = orowan.at("parameters")[p].at("value");
    EXPECT_NEAR(a, b, 1e-4 * b);
  }
  EXPECT_NEAR(mine.at("validation").at("mae_MPa"), orowan.at("validation").at("mae_MPa"), 1e-3);
}

// SYNTHETIC: 12 tests, stress = 0.1 sigma_n (humidity/50)^-0.5; in one row no humidity.
class OwnLaw : public testing::Test {
protected:
  void SetUp() override {
    for (const bool with_gap : {true, false}) {
      std::string rows = "experiment,sigma_n_MPa,humidity_pct,tau_R_MPa\n";
      for (int test = 0; test < 12; ++test)
        for (int row = 0; row < 5; ++row) {
          const bool gap = test == 2 && row == 3;
          if (gap && !with_gap) continue;
          const double sigma = 300 + 40 * row + 10 * test, humidity = 30 + 4 * test;
          rows += fmt::format("E{:02},{},{},{}\n", test, sigma, gap ? "" : std::to_string(humidity),
                              0.1 * sigma * std::pow(humidity / 50, -0.5));
        }
      directory.write(with_gap ? "gap.csv" : "whole.csv", rows);
    }
  }
  CommandResult calibrate(const std::string& file, const std::string& formula,
                          const std::string& more = "") {
    directory.write("job.toml", "[data]\ntraining = \"" + file + "\"\n" + more +
                                    "[models]\nuse = [\"mine\"]\n[models.mine]\nformula = \"" +
                                    formula +
                                    "\"\nparameters = { mu = { range = [0.001, 1] }, b = { range "
                                    "= [-2, 2] } }\n");
    return run_frictab({"calibrate", "job.toml", "--force"}, directory.path());
  }
  static constexpr const char* humid = "mu*sigma_n_MPa*(humidity_pct/50)^b";
  TemporaryDirectory directory;
};

TEST_F(OwnLaw, IsNotFittedToRowsThatLackAColumnItTakes) {
  const CommandResult error = calibrate("gap.csv", humid);
  EXPECT_EQ(error.exit_code, 2);
  EXPECT_EQ(error.err, "gap.csv: error: humidity_pct is empty in row 4 of 'E02', and mine needs "
                       "it\n  hint: repair the cell; in a job data.missing = \"drop\" leaves such "
                       "rows out of the calibration\n");
  EXPECT_FALSE(std::filesystem::exists(directory.path("out/calibration.json")));
  const CommandResult left_out = calibrate("gap.csv", humid, "missing = \"drop\"\n");
  ASSERT_EQ(left_out.exit_code, 0) << left_out.err;
  EXPECT_THAT(left_out.out, HasSubstr("\n  left out: 1 row, no humidity_pct\n"));
  const auto parameters = [&] {
    return nlohmann::json::parse(directory.read("out/calibration.json"))["models"][0]["parameters"];
  };
  const auto dropped = parameters();
  EXPECT_NEAR(dropped[1]["value"], -0.5, 1e-6);
  ASSERT_EQ(calibrate("whole.csv", humid).exit_code, 0);
  EXPECT_EQ(parameters()[0]["value"], dropped[0]["value"]);
  EXPECT_EQ(parameters()[1]["value"], dropped[1]["value"]);
}

TEST_F(OwnLaw, ThatHasNoValueInSomeRowIsAnErrorWithItsStates) {
  const CommandResult result =
      calibrate("whole.csv", "mu*sigma_n_MPa*(1 + b*log(humidity_pct - 40))");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              HasSubstr("whole.csv: error: mine gives no stress in row 1 of 'E00' and 13 "
                        "more\n  hint: a logarithm or a power of a negative number, or "
                        "a division by 0? The states of the first: sigma_n_MPa = 300, "
                        "humidity_pct = 30"));
}

class LongOwnLaw : public SlowOwnLaw {};

TEST_F(LongOwnLaw, GoesTheWholeWayAndIsReadBack) {
  directory.write("laws/film.toml",
                  "[film]\ntitle = \"a film that slides off\"\n"
                  "formula = \"min(mu*sigma_n_MPa*growth*(v_rel_mm_s/10)^b, m*k_MPa)\"\n"
                  "where = { growth = \"1 + a*(1 - exp(-s_mm/s0))\" }\n"
                  "parameters = { mu = { range = [0.001, 1] }, a = { range = [-0.5, 2] }, "
                  "b = { range = [-1, 1] }, s0 = 2.0, m = { range = [0, 1] } }\n");
  write_job("[models]\nuse = [\"coulomb\", \"film\"]\nfiles = \"laws/*.toml\"\n"
            "[table]\nmodel = \"film\"\n[export]\ntargets = [\"c\", \"abaqus_vfric\"]\n"
            "[trace]\nmodels = [\"film\"]\n");
  const CommandResult result = frictab({"run", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_THAT(directory.read("out/report.html"), HasSubstr("<math>"));
  EXPECT_THAT(frictab({"explain", "film"}).out, HasSubstr("minimum(value*sigma_n_MPa, m*("));

  const CommandResult verified =
      frictab({"verify", "--table", "out/tables/film.h5", "--model", "out/models/film.json",
               "--data", "data/validation.csv", "--max-drift-MPa", "0.5"});
  EXPECT_EQ(verified.exit_code, 0) << verified.err << verified.out;
  const CommandResult predicted =
      frictab({"predict", "out/models/film.json", "data/validation.csv", "-o", "p.csv"});
  EXPECT_EQ(predicted.exit_code, 0) << predicted.err;

  const std::string table = directory.read("out/tables/film.h5");
  ASSERT_EQ(frictab({"tabulate", "job.toml"}).exit_code, 0);
  EXPECT_TRUE(directory.read("out/tables/film.h5") == table) << "by the calibration's file alone";

  // A law that the job no longer has leaves nothing behind.
  write_job(
      "[models]\nuse = [\"coulomb\"]\n[table]\nmodel = \"coulomb\"\n[export]\ntargets = [\"c\"]\n");
  ASSERT_EQ(frictab({"run", "job.toml"}).exit_code, 0);
  EXPECT_FALSE(std::ifstream(directory.path("out/models/film.json")).good());
  EXPECT_FALSE(std::ifstream(directory.path("out/tables/film.h5")).good());
}

TEST_F(SlowOwnLaw, ThatIsInfiniteInItsRangeIsToldWithTheState) {
  write_job("[models]\nuse = [\"mine\"]\n[models.mine]\n"
            "formula = \"mu*sigma_n_MPa*psi/(psi - 1)\"\n"
            "parameters = { mu = { range = [0, 1] } }\n[table]\nmodel = \"mine\"\n"
            "[table.axes]\npsi = { range = [1, 4] }\n[export]\ntargets = []\n");
  const CommandResult result = frictab({"run", "job.toml", "-q"});
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.err, testing::HasSubstr("psi = 1"));
  EXPECT_THAT(result.err, testing::Not(testing::HasSubstr(".frictab-")));
}

TEST_F(SlowOwnLaw, OfConstantsAloneIsNotCalibrated) {
  write_job("[models]\nuse = [\"coulomb\", \"paper\"]\n[models.paper]\n"
            "formula = \"mu*sigma_n_MPa\"\nparameters = { mu = 0.06 }\n");
  ASSERT_EQ(frictab({"calibrate", "job.toml"}).exit_code, 0);
  EXPECT_EQ(fit("paper").at("parameters")[0].at("value"), 0.06);
  EXPECT_EQ(fit("paper").at("termination"), "not calibrated");
}

TEST_F(SlowOwnLaw, OfAFileStandsAtItsTop) {
  directory.write("laws.toml", "[models.film]\nformula = \"mu*sigma_n_MPa\"\n"
                               "parameters = { mu = { range = [0, 1] } }\n");
  write_job("[models]\nuse = [\"coulomb\"]\nfiles = \"laws.toml\"\n");
  const CommandResult result = frictab({"calibrate", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("laws.toml:1:2: error: a file of models.files has its laws at "
                                    "the top\n  hint: [mine] and [mine.parameters], not "
                                    "[models.mine]"));
}

TEST_F(SlowOwnLaw, NamesAColumnThatTheDataDoNotHaveWhereItStands) {
  write_job("[models.mine]\nformula = \"mu*sigma_n_MPa*(1 + a*humidty_pct)\"\n"
            "parameters = { mu = { range = [0, 1] }, a = { range = [-1, 1] } }\n");
  const CommandResult result = frictab({"calibrate", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("job.toml:5:34: error: law mine: needs humidty_pct, which the "
                                    "data do not have"));
}

TEST_F(SlowOwnLaw, MayFollowAHistoryOfItsOwnStress) {
  write_job("[models]\nuse = [\"coulomb\", \"mine\"]\n[models.mine]\n"
            "formula = \"mu*sigma_n_MPa*exp(-friction_work/w0)\"\n"
            "parameters = { mu = { range = [0.001, 1] }, w0 = { range = [10, 1e6] } }\n");
  const CommandResult result = frictab({"calibrate", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_LE(fit("mine").at("training").at("rmse_MPa").get<double>(),
            fit("coulomb").at("training").at("rmse_MPa").get<double>() * 1.001);
}

} // namespace
} // namespace frictab::own_law_test
