// Runs that do not end: what they had finished is there for the next one, which gives the same
// bytes; where nothing was finished nothing is left.
#include <algorithm>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text.h"
#include "io/file_streams.h"
#include "support/small_campaign.h"

namespace frictab::interrupted_run_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_command;
using test::run_frictab;
using testing::HasSubstr;

using Files = std::map<std::string, std::string>;

class SlowInterruptedRun : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    export_to("[\"c\"]");
  }
  void export_to(const std::string& targets) const {
    write_job("[models]\nuse = [\"coulomb\", \"shear\", \"levanov\"]\n"
              "[table]\nmodel = [\"shear\", \"levanov\"]\n"
              "[export]\ntargets = " +
              targets + "\n" + test::no_causes);
  }
  Files results() const {
    Files files;
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(directory.path("out"), none))
      if (entry.is_regular_file())
        files[fs::relative(entry.path(), directory.path("out")).string()] =
            io::read_file(entry.path());
    return files;
  }
  CommandResult run(const std::vector<std::string>& environment = {}) {
    return frictab({"run", "job.toml", "-j1"}, environment);
  }
};

TEST_F(SlowInterruptedRun, GoesOnWhereItWasToTheSameBytes) {
  ASSERT_EQ(run().exit_code, 0);
  const Files whole = results();
  bool calibration = false, shear = false, levanov = false;
  for (const int call : {5, 20, 40, 60, 75, 90, 110, 140}) { // calls that change files
    fs::remove_all(directory.path("out"));
    const CommandResult killed = run(
        {"LD_PRELOAD=" + test::failing_disk(), "FAIL_AT=" + std::to_string(call), "FAIL_HOW=kill"});
    ASSERT_NE(killed.exit_code, 0) << call;
    const CommandResult again = run();
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(results() == whole) << "killed at call " << call;
    const auto took = [&](const std::string& what) {
      return again.err.find(what + " is that of a run that did not end\n") != std::string::npos;
    };
    calibration |= took("the calibration");
    shear |= took("the table of shear");
    levanov |= took("the table of levanov");
  }
  EXPECT_TRUE(calibration);
  EXPECT_TRUE(shear);
  EXPECT_TRUE(levanov);
}

TEST_F(SlowInterruptedRun, WorkOfAnotherJobOrOtherDataIsNotTaken) {
  const std::vector<std::string> kill = {"LD_PRELOAD=" + test::failing_disk(), "FAIL_AT=60",
                                         "FAIL_HOW=kill"};
  ASSERT_NE(run(kill).exit_code, 0);
  ASSERT_TRUE(fs::exists(directory.path("out")));
  const std::string data = directory.read("data/training.csv");
  directory.write("data/training.csv", replace_all(data, "\nE001,", "\nE999,"));
  const CommandResult other = run();
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_EQ(other.err.find("did not end"), std::string::npos) << other.err;
  EXPECT_FALSE(fs::exists(directory.path("out/.frictab-kept"))) << "it is done with";
}

TEST_F(SlowInterruptedRun, FailureOfALateStageKeepsTheEarlierOnesAndSaysSo) {
  const CommandResult broken = run({"TMPDIR=/nowhere/at/all"}); // where routines are compiled
  EXPECT_EQ(broken.exit_code, 2) << broken.err;
  EXPECT_THAT(broken.err, HasSubstr("what was finished is kept in out/.frictab-kept; `frictab run "
                                    "job.toml` goes on from there\n"));
  const CommandResult again = run();
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_THAT(again.err, HasSubstr("the calibration is that of a run that did not end\n"));
}

TEST_F(SlowInterruptedRun, LeavesNothingWhereNothingWasFinished) {
  const std::string temporary = directory.path("tmp");
  fs::create_directories(temporary);
  ASSERT_EQ(run_frictab({"twin", directory.path("data"), "--seed", "3", "--force"}).exit_code, 0)
      << "a campaign that is calibrated for seconds";
  for (const char* signal : {"INT", "TERM", "HUP"}) {
    const CommandResult stopped = run_command({"timeout", "-s", signal, "0.3", test::program(),
                                               "run", "job.toml", "--set", "models.use=\"all\""},
                                              directory.path(), {"TMPDIR=" + temporary});
    EXPECT_EQ(stopped.exit_code, 124) << "timeout says that it had to stop it";
    EXPECT_FALSE(fs::exists(directory.path("out"))) << signal;
    EXPECT_TRUE(fs::is_empty(temporary)) << signal;
  }
}

TEST_F(SlowInterruptedRun, StopsItsCompilerAndKeepsWhatWasFinished) {
  const std::string compiler = directory.write(
      "bin/gcc", "#!/bin/sh\nsleep 77 & echo $! > " + directory.path("child") + "\nsleep 77\n");
  fs::permissions(compiler, fs::perms::owner_all);
  const std::string temporary = directory.path("tmp");
  fs::create_directories(temporary);
  const std::string path = std::getenv("PATH");
  const CommandResult stopped = run_command(
      {"sh", "-c",
       "'" + test::program() +
           "' run job.toml & it=$!\n"
           "while [ ! -s child ]; do sleep 0.05; done\nkill -TERM $it; wait $it\necho code $?\n"
           "sleep 0.2; case $(cut -d' ' -f3 /proc/$(cat child)/stat 2>/dev/null) in R|S|D) "
           "echo alive;; esac"},
      directory.path(), {"PATH=" + directory.path("bin") + ":" + path, "TMPDIR=" + temporary});
  EXPECT_THAT(stopped.out, HasSubstr("code 143\n"));
  EXPECT_THAT(stopped.out, testing::Not(HasSubstr("alive")));
  EXPECT_THAT(stopped.err, HasSubstr("what was finished is kept in out/.frictab-kept"));
  EXPECT_TRUE(fs::is_empty(temporary));
  const Files left = results();
  for (const auto& [name, text] : left)
    EXPECT_TRUE(name.starts_with(".frictab-kept/")) << name;
  EXPECT_TRUE(left.count(".frictab-kept/calibration.json"));
}

} // namespace
} // namespace frictab::interrupted_run_test
