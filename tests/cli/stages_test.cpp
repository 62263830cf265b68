// Stages that know what the results they go on from were made of: what is missing is made (but not
// by verify, verify_gate_test.cpp), what is stale is named.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::stages_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::EndsWith;
using testing::HasSubstr;

class StagesOfAJob : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(run_frictab({"twin", directory.path("data"), "--seed", "3", "--design",
                           "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=20;validation=6"})
                  .exit_code,
              0);
    write_job(0.5);
  }
  void write_job(double tolerance, const std::string& more = "") {
    directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                                "validation = \"data/validation.csv\"\n"
                                "[models]\nuse = [\"coulomb\", \"levanov\"]\n"
                                "[table]\nmodel = \"levanov\"\ntolerance_MPa = " +
                                    std::to_string(tolerance) + "\n" + more);
  }
  CommandResult run(const std::vector<std::string>& arguments) {
    return run_frictab(arguments, directory.path());
  }
  std::string status() { return run({"status", "job.toml"}).out; }
  void change_data() {
    std::string text = directory.read("data/training.csv");
    const std::size_t digit = text.find_last_of("123456789");
    text[digit] = text[digit] == '9' ? '8' : '9';
    directory.write("data/training.csv", text);
  }

  TemporaryDirectory directory;
};

using SlowStagesOfAJob = StagesOfAJob;

TEST_F(StagesOfAJob, MakeWhatIsMissingFirst) {
  EXPECT_EQ(status(), "calibrate  missing\ntrace      missing\ntabulate   missing\n"
                      "export     missing\nverify     missing\nnext: frictab run job.toml\n");
  const CommandResult result = run({"export", "job.toml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "there was no calibration: the laws were calibrated first\n"
                        "there were no tables: they were made first\n");
  EXPECT_EQ(run({"verify", "job.toml"}).err, "");
  EXPECT_EQ(status(), "calibrate  done\ntrace      missing\ntabulate   done\n"
                      "export     done\nverify     done\nnothing is left to do\n");
  for (const char* file : {"calibration.json", "tables/levanov.h5", "verify.json"})
    EXPECT_TRUE(fs::exists(directory.path(std::string("out/") + file))) << file;
}

TEST_F(StagesOfAJob, AdviceRepeatsWhatTheCommandLineSaid) {
  const std::vector<std::string> said = {"-o", "a loose one", "--seed",
                                         "7",  "--set",       "table.tolerance_MPa=0.4"};
  const auto with_said = [&](std::vector<std::string> command) {
    command.insert(command.end(), said.begin(), said.end());
    return run(command).out;
  };
  const std::string repeated =
      " job.toml -o 'a loose one' --seed 7 --set table.tolerance_MPa=0.4\n";
  EXPECT_THAT(with_said({"calibrate", "job.toml"}), EndsWith("next: frictab tabulate" + repeated));
  EXPECT_THAT(with_said({"status", "job.toml"}), EndsWith("next: frictab run" + repeated));
}

TEST_F(StagesOfAJob, NameResultsOfOtherData) {
  ASSERT_EQ(run({"calibrate", "job.toml"}).exit_code, 0);
  change_data();
  const CommandResult result = run({"tabulate", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "out/calibration.json: error: is stale: the data have changed since\n"
                        "  hint: `frictab calibrate job.toml` rebuilds it, `frictab run` "
                        "everything; `frictab status` shows all stages\n");
  EXPECT_THAT(status(), HasSubstr("calibrate  stale: the data have changed since\n"));
  EXPECT_EQ(run({"calibrate", "job.toml"}).exit_code, 0);
  EXPECT_EQ(run({"tabulate", "job.toml"}).exit_code, 0);
}

TEST_F(SlowStagesOfAJob, NameResultsOfAnotherJob) {
  ASSERT_EQ(run({"export", "job.toml"}).exit_code, 0);
  ASSERT_EQ(run({"verify", "job.toml"}).exit_code, 0);
  write_job(0.25);
  CommandResult result = run({"verify", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              HasSubstr("out/tables: error: is stale: [table] of the job has changed since\n"));
  EXPECT_EQ(status(), "calibrate  done\ntrace      missing\n"
                      "tabulate   stale: [table] of the job has changed since\n"
                      "export     stale: `tabulate` is stale\nverify     stale: `tabulate` is "
                      "stale\nnext: frictab run job.toml\n");
  ASSERT_EQ(run({"tabulate", "job.toml"}).exit_code, 0);
  result = run({"verify", "job.toml"});
  EXPECT_EQ(result.exit_code, 2) << "the sources are of the table before";
  EXPECT_THAT(result.err, HasSubstr("out/export: error: is stale: made before the last `tabulate`\n"
                                    "  hint: `frictab export job.toml` rebuilds it"));
  ASSERT_EQ(run({"export", "job.toml"}).exit_code, 0);
  EXPECT_EQ(run({"verify", "job.toml"}).exit_code, 0);
}

TEST_F(SlowStagesOfAJob, HoldWhatTheyDoNotDependOn) {
  ASSERT_EQ(run({"export", "job.toml"}).exit_code, 0);
  ASSERT_EQ(run({"verify", "job.toml"}).exit_code, 0);
  write_job(0.5, "[verify]\nsamples = 3000\n[output]\ndirectory = \"out\"\n");
  EXPECT_EQ(run({"report", "job.toml"}).exit_code, 0);
  EXPECT_THAT(status(), HasSubstr("export     done\nverify     stale: [verify] of the job has "
                                  "changed since\nnext: frictab verify job.toml\n"));
}

TEST_F(SlowStagesOfAJob, NamesOfLawsPickAmongTheTablesAndBestDoesNot) {
  ASSERT_EQ(
      run({"tabulate", "job.toml", "--set", "table.model=[\"levanov\", \"coulomb\"]"}).exit_code,
      0);
  EXPECT_EQ(run({"export", "job.toml"}).exit_code, 0);
  EXPECT_THAT(status(), HasSubstr("tabulate   done\nexport     done\n"));
  const CommandResult best = run({"export", "job.toml", "--set", "table.model=best"});
  EXPECT_EQ(best.exit_code, 2);
  EXPECT_THAT(best.err, HasSubstr("out/tables: error: is stale: table.model of the job has changed "
                                  "since\n"));
  ASSERT_EQ(run({"tabulate", "job.toml", "--set", "table.model=coulomb"}).exit_code, 0);
  EXPECT_THAT(status(), HasSubstr("tabulate   stale: there is no table of levanov\n"));
}

TEST_F(SlowStagesOfAJob, TracingMakesTablesBeforeItStale) {
  write_job(0.5, "[trace]\nignore = [\"humidity_pct\"]\n");
  ASSERT_EQ(run({"tabulate", "job.toml"}).exit_code, 0);
  ASSERT_EQ(run({"trace", "job.toml"}).exit_code, 0);
  const CommandResult result = run({"export", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("out/tables: error: is stale: made before the last `trace`"));
}

TEST_F(StagesOfAJob, DamagedRecordIsAFaultWithItsMend) {
  ASSERT_EQ(run({"calibrate", "job.toml"}).exit_code, 0);
  directory.write("out/stages.json",
                  "{\"schema\": \"frictab/stages/1\", \"stages\": {\"calibrate\": {}}}");
  const CommandResult result = run({"tabulate", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("stages.json"));
  EXPECT_THAT(result.err, HasSubstr("remove it, then `frictab run`"));
}

} // namespace
} // namespace frictab::stages_test
