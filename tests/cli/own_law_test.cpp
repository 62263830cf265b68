// A law of the job file goes the whole way: calibrated, tabulated, exported, verified, read back.
#include <fstream>

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

TEST_F(SlowOwnLaw, GoesTheWholeWayAndIsReadBack) {
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
