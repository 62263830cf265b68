// Results stand in place neither of what a job reads nor of files that frictab did not write.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/small_campaign.h"

namespace frictab::files_of_others_test {
namespace {

using test::CommandResult;
using testing::AllOf;
using testing::HasSubstr;

class FilesOfOthers : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job(std::string("[models]\nuse = [\"coulomb\"]\n[export]\ntargets = [\"c\"]\n") +
              test::no_causes);
  }
};

TEST_F(FilesOfOthers, DataThatAreReadAreNotWrittenOverEvenByForce) {
  const std::string data = directory.read("data/training.csv");
  directory.write("data.csv", data);
  directory.write("here.toml", "[data]\ntraining = \"data.csv\"\n[output]\ndirectory = \".\"\n");
  for (const char* force : {"-q", "--force"}) {
    const CommandResult result = frictab({"data", "here.toml", "--write", "csv", force});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("data.csv: error: is read by this job, and a result comes "
                                      "there\n  hint: choose another directory: -o DIR"));
  }
  EXPECT_EQ(directory.read("data.csv"), data);
  EXPECT_FALSE(std::filesystem::exists(directory.path("data.html")));
}

TEST_F(FilesOfOthers, AreLeftAloneByEveryStageAndReplacedByForce) {
  for (const char* file : {"out/report.html", "out/models/coulomb.json", "out/benchmark.md",
                           "out/errors_by_experiment.csv", "out/export/c/frictab_tau_R.c"}) {
    directory.write(file, "mine\n");
    const CommandResult result = frictab({"run", "job.toml", "-q"});
    EXPECT_EQ(result.exit_code, 2) << file;
    EXPECT_THAT(result.err,
                AllOf(HasSubstr("out: error: has files called like results that frictab did not "
                                "write: " +
                                std::string(file).substr(4) + "\n"),
                      HasSubstr("or --force to replace them\n")));
    EXPECT_EQ(directory.read(file), "mine\n");
    std::filesystem::remove(directory.path(file));
  }
  directory.write("out/models/coulomb.json", "mine\n");
  EXPECT_EQ(frictab({"run", "job.toml", "-q", "--force"}).exit_code, 0);
  EXPECT_THAT(directory.read("out/models/coulomb.json"), HasSubstr("frictab/model/1"));
}

TEST_F(FilesOfOthers, AreToldBeforeALongRunAndByItsDryRun) {
  directory.write("out/trace.json", "mine\n");
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{"--dry-run"}, {"-q", "--set", "calibration.bootstrap=0"}}) {
    std::vector<std::string> words{"run", "job.toml"};
    words.insert(words.end(), more.begin(), more.end());
    const CommandResult result = frictab(words);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, HasSubstr("did not write: trace.json"));
  }
  EXPECT_FALSE(std::filesystem::exists(directory.path("out/calibration.json")));
}

TEST_F(FilesOfOthers, ResultsOfFrictabAreReplacedWithAndWithoutTheirRecord) {
  ASSERT_EQ(frictab({"run", "job.toml", "-q"}).exit_code, 0);
  ASSERT_EQ(frictab({"data", "job.toml", "--write", "csv", "-q"}).exit_code, 0);
  EXPECT_EQ(frictab({"run", "job.toml", "-q"}).exit_code, 0);
  std::filesystem::remove(directory.path("out/stages.json"));
  EXPECT_EQ(frictab({"run", "job.toml", "-q"}).exit_code, 0);
  EXPECT_EQ(frictab({"data", "job.toml", "--write", "csv", "-q"}).exit_code, 0);
}

} // namespace
} // namespace frictab::files_of_others_test
