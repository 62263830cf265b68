// calibration.deliver through the commands: what is written, said and found stale.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"

namespace frictab::deliver_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;

class DeliveredLaws : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(run_frictab({"twin", directory.path("data"), "--seed", "3", "--design",
                           "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=20;validation=6"})
                  .exit_code,
              0);
    write_job("all");
  }
  void write_job(const std::string& deliver) {
    directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                                "validation = \"data/validation.csv\"\n"
                                "[models]\nuse = [\"coulomb\", \"levanov\"]\n"
                                "[calibration]\ndeliver = \"" +
                                    deliver + "\"\n[table]\nmodel = \"levanov\"\n");
  }
  CommandResult run(const std::vector<std::string>& arguments) {
    return run_frictab(arguments, directory.path());
  }
  nlohmann::ordered_json json(const std::string& file) {
    return test::parse_json(directory.read(file));
  }

  TemporaryDirectory directory;
};

TEST_F(DeliveredLaws, OfAllExperimentsAreInTheFilesAndTheTextSaysSo) {
  const CommandResult result = run({"calibrate", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              testing::ContainsRegex(
                  "\n  Delivered: fitted again to all 22 experiments; cross-validated over these "
                  "(levanov|coulomb) errs by [0-9.]+ MPa \\([0-9.]+ to [0-9.]+\\), each "
                  "experiment left out in turn; the errors above are of the fits to the 16 "
                  "experiments of the training\\.\n"));
  const std::string benchmark = directory.read("out/benchmark.md");
  EXPECT_THAT(benchmark, HasSubstr("\nDelivered: fitted again to all 22 experiments; "));
  EXPECT_THAT(benchmark, HasSubstr("\n| delivered law | cross-validated MAE | 95 % interval | RMSE "
                                   "| bias | parameters \u00B1 standard error |\n"));
  const auto calibration = json("out/calibration.json");
  EXPECT_EQ(calibration.at("deliver"), "all");
  EXPECT_EQ(calibration.at("delivery_folds"), 22);
  for (const auto& fit : calibration.at("models")) {
    const auto file = json("out/models/" + fit.at("name").get<std::string>() + ".json");
    EXPECT_EQ(file.at("parameters"), fit.at("delivered").at("parameters"));
    EXPECT_NE(file.at("parameters"), fit.at("parameters"));
    EXPECT_EQ(file.at("fitted_to"), "all");
    EXPECT_EQ(fit.at("training").at("n_experiments"), 16);
    EXPECT_EQ(fit.at("validation").at("n_experiments"), 6);
    EXPECT_EQ(fit.at("delivered").at("training").at("n_experiments"), 22);
    EXPECT_EQ(fit.at("delivered").at("cross_validation").at("n_experiments"), 22);
  }
}

TEST_F(DeliveredLaws, OfTheTrainingAreTheDefault) {
  write_job("training");
  const CommandResult result = run({"calibrate", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string said =
      "elivered: fitted to the 16 experiments of the training; calibration.deliver = \"all\" fits "
      "again to all";
  EXPECT_THAT(result.out, HasSubstr("\n  D" + said + ".\n"));
  EXPECT_THAT(directory.read("out/benchmark.md"), HasSubstr("\nD" + said + ".\n"));
  EXPECT_EQ(json("out/calibration.json").at("deliver"), "training");
  EXPECT_THAT(directory.read("out/models/levanov.json"), Not(HasSubstr("fitted_to")));
}

TEST_F(DeliveredLaws, OfAllExperimentsArePredictedWith) {
  ASSERT_EQ(run({"calibrate", "job.toml"}).exit_code, 0);
  const CommandResult of_job = run({"predict", "job.toml", "data/validation.csv", "-o", "a.csv"});
  ASSERT_EQ(of_job.exit_code, 0) << of_job.err;
  EXPECT_THAT(
      of_job.out + of_job.err,
      HasSubstr("\nThe law was fitted to all experiments of its job: on these its errors are "
                "of the fit\n"));
  const CommandResult of_file =
      run({"predict", "out/models/levanov.json", "data/validation.csv", "-o", "b.csv"});
  ASSERT_EQ(of_file.exit_code, 0) << of_file.err;
  EXPECT_EQ(directory.read("a.csv"), directory.read("b.csv"));
}

TEST_F(DeliveredLaws, AreAnotherKeyThanAnyOther) {
  write_job("everything");
  const CommandResult result = run({"calibrate", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("job.toml:7:11: error: calibration.deliver must be "
                                    "\"training\" or \"all\", not the text \"everything\"\n"));
  EXPECT_THAT(run({"explain", "calibration.deliver"}).out,
              HasSubstr("all = the laws fitted again to training and validation\n"
                        "  experiments together"));
}

struct LongDeliveredLaws : DeliveredLaws {};

// Coulomb's mu knows no state: the trace adds what it follows.
TEST_F(LongDeliveredLaws, WithTracedEffectsAreFittedToAllExperimentsAsWell) {
  const std::vector<std::string> traced = {"--set", "models.use=[\"coulomb\"]", "--set",
                                           "table.model=coulomb_traced"};
  const auto with = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), traced.begin(), traced.end());
    return run(arguments);
  };
  ASSERT_EQ(with({"calibrate", "job.toml"}).exit_code, 0);
  const CommandResult result = with({"trace", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto calibration = json("out/calibration.json");
  const auto& models = calibration.at("models");
  const auto fit = std::find_if(models.begin(), models.end(),
                                [](const auto& one) { return one.at("name") == "coulomb_traced"; });
  ASSERT_NE(fit, models.end()) << result.out;
  EXPECT_EQ(fit->at("training").at("n_experiments"), 22) << "six to validate are searched as well";
  EXPECT_EQ(fit->at("delivered").at("training").at("n_experiments"), 22);
  EXPECT_EQ(fit->at("delivered").at("cross_validation").at("n_experiments"), 22);
  const auto model = json("out/models/coulomb_traced.json");
  EXPECT_EQ(model.at("parameters"), fit->at("delivered").at("parameters"));
  EXPECT_EQ(model.at("fitted_to"), "all");
  EXPECT_THAT(directory.read("out/benchmark.md"),
              testing::Not(HasSubstr("delivered as traced, fitted to the training")));
  const CommandResult tables = with({"tabulate", "job.toml"});
  EXPECT_EQ(tables.exit_code, 0) << tables.err;
  const CommandResult verified =
      run({"verify", "--table", "out/tables/coulomb_traced.h5", "--model",
           "out/models/coulomb_traced.json", "--data", "data/training.csv"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
}

TEST_F(LongDeliveredLaws, OfAllExperimentsAreInTablesAndSources) {
  const CommandResult result = run({"run", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(
      directory.read("out/report.html"),
      HasSubstr("Delivered are the laws fitted again to all 22 experiments; on new tests "));
  const CommandResult verified =
      run({"verify", "--table", "out/tables/levanov.h5", "--model", "out/models/levanov.json",
           "--data", "data/training.csv", "--max-drift-MPa", "0.5"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  const std::string of_all = directory.read("out/tables/levanov.h5");
  EXPECT_THAT(run({"status", "job.toml"}).out, HasSubstr("nothing is left to do\n"));

  write_job("training");
  EXPECT_THAT(
      run({"status", "job.toml"}).out,
      HasSubstr("calibrate  stale: [models] or [calibration] of the job has changed since"));
  const CommandResult stale = run({"tabulate", "job.toml"});
  EXPECT_EQ(stale.exit_code, 2);
  EXPECT_THAT(stale.err, HasSubstr("out/calibration.json: error: is stale: [models] or "
                                   "[calibration] of the job has changed since\n"));
  ASSERT_EQ(run({"run", "job.toml"}).exit_code, 0);
  EXPECT_NE(directory.read("out/tables/levanov.h5"), of_all);
}

} // namespace
} // namespace frictab::deliver_test
