// Disks that fail and processes that die, at calls that change a file: results are those of before
// or those of after, never both, and never claimed where they are neither.
#include <algorithm>
#include <filesystem>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file_streams.h"
#include "support/small_campaign.h"

namespace frictab::failing_disk_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_command;
using test::run_frictab;
using testing::HasSubstr;

using Files = std::map<std::string, std::string>;

class LongFailingDisk : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job("[models]\nuse = [\"coulomb\", \"shear\"]\n"
              "[table]\nmodel = \"shear\"\n[export]\ntargets = []\n" +
              std::string(test::no_causes));
  }

  Files results() const {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(directory.path("out")))
      if (entry.is_regular_file() && entry.path().filename() != ".frictab.lock") // held by nobody
        files[fs::relative(entry.path(), directory.path("out")).string()] =
            io::read_file(entry.path());
    return files;
  }

  void put_back(const Files& files) {
    fs::remove_all(directory.path("out"));
    for (const auto& [name, text] : files)
      directory.write("out/" + name, text);
  }

  // Its call number `at` fails.
  CommandResult failing(const std::vector<std::string>& arguments, int at, const std::string& how) {
    return frictab(arguments, {"LD_PRELOAD=" + test::failing_disk(),
                               "FAIL_AT=" + std::to_string(at), "FAIL_HOW=" + how});
  }

  // Every `step`-th call of the command fails in turn, from call `first` on. The number of calls.
  int fail_each(const std::vector<std::string>& command, const std::string& how, int first,
                int step, const Files& before, const Files& after) {
    for (int n = first; n < 2000; n += step) {
      put_back(before);
      const CommandResult result = failing(command, n, how);
      const bool claimed = result.exit_code == 0;
      EXPECT_TRUE(result.exit_code <= 3 || how == "kill")
          << how << " of call " << n << " ends with " << result.exit_code;
      if (claimed) {
        EXPECT_TRUE(results() == after) << how << " of call " << n << " is not told";
      }
      Files found = results();
      const bool left = std::any_of(found.begin(), found.end(), [](const auto& file) {
        return file.first.starts_with(".frictab");
      });
      if (left) {
        EXPECT_EQ(frictab({"status", "job.toml"}).exit_code, 0);
        found = results();
      }
      if (how == "kill") // what was never begun to be committed goes with the next that writes
        std::erase_if(found, [](const auto& file) { return file.first.starts_with(".frictab"); });
      EXPECT_TRUE(found == before || found == after) << how << " of call " << n << ": mixed";
      if (claimed && how == "kill") return n; // it has fewer calls
      if (claimed && failing(command, n, "kill").exit_code == 0) return n;
    }
    ADD_FAILURE() << "it never ends";
    return 0;
  }
};

TEST_F(LongFailingDisk, CalibrationIsThatOfBeforeOrThatOfAfter) {
  const std::vector<std::string> again = {
      "calibrate", "job.toml", "-j1", "-q", "--set", "models.use=[\"shear\", \"orowan\"]"};
  ASSERT_EQ(frictab({"calibrate", "job.toml", "-j1"}).exit_code, 0);
  const Files before = results();
  ASSERT_EQ(frictab(again).exit_code, 0);
  const Files after = results();
  ASSERT_NE(before, after);
  EXPECT_GT(fail_each(again, "EIO", 1, 3, before, after), 30);
  EXPECT_GT(fail_each(again, "kill", 2, 3, before, after), 30);
}

TEST_F(LongFailingDisk, TablesHoldTheirValuesOrAreNotWritten) {
  const std::vector<std::string> again = {"tabulate", "job.toml", "-j1",
                                          "-q",       "--set",    "table.tolerance_MPa=0.1"};
  ASSERT_EQ(frictab({"tabulate", "job.toml", "-j1"}).exit_code, 0);
  const Files before = results();
  ASSERT_EQ(frictab(again).exit_code, 0);
  const Files after = results();
  ASSERT_NE(before, after);
  EXPECT_GT(fail_each(again, "EIO", 3, 5, before, after), 20);
  EXPECT_GT(fail_each(again, "kill", 1, 5, before, after), 20);
}

TEST_F(LongFailingDisk, TwoAtATimeAreNotLetInAndTheMessageSaysWhoIsThere) {
  fs::create_directories(directory.path("out"));
  const CommandResult result = run_command(
      {"sh", "-c",
       "(flock 9; echo 'process 7 on rig since noon' >&9; sleep 6) 9> out/.frictab.lock &\n"
       "sleep 0.5; '" +
           test::program() + "' calibrate job.toml"},
      directory.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "out: error: another frictab is writing here: process 7 on rig since noon\n"
                        "  hint: wait until it has finished, or choose another directory with -o "
                        "DIR\n");
}

TEST_F(LongFailingDisk, WithoutLocksItIsSaidThatNobodyIsKeptOff) {
  const CommandResult result = run_frictab({"calibrate", "job.toml"}, directory.path(),
                                           {"LD_PRELOAD=" + test::failing_disk(), "NO_LOCKS=1"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "out is on a file system without locks: run one frictab at a time there\n");
}

TEST_F(LongFailingDisk, NothingIsWrittenThroughALinkThatLeadsElsewhere) {
  fs::create_directories(directory.path("victim"));
  fs::create_directories(directory.path("out"));
  fs::create_directory_symlink(directory.path("victim"), directory.path("out/models"));
  const CommandResult result = frictab({"calibrate", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("out/models: error: is a symbolic link, and nothing is written "
                                    "through it"));
  EXPECT_TRUE(fs::is_empty(directory.path("victim")));
}

} // namespace
} // namespace frictab::failing_disk_test
