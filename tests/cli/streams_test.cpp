// Streams that are full, closed or read by nobody: every command ends with its own exit code.
#include <filesystem>

#include <gmock/gmock.h>

#include "support/small_campaign.h"

namespace frictab::streams_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_command;
using testing::HasSubstr;

class Streams : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job("[models]\nuse = [\"coulomb\"]\n[export]\ntargets = [\"c\"]\n");
  }

  CommandResult shell(const std::string& before, const std::string& arguments,
                      const std::string& after) const {
    return run_command({"sh", "-c", before + " '" + test::program() + "' " + arguments + after},
                       directory.path());
  }
};

TEST_F(Streams, OfAFaultMayBeFullOrClosed) {
  for (const char* lost : {" 2>/dev/full", " 2>&-", " >&- 2>&-", " <&- >&- 2>&-"}) {
    EXPECT_EQ(shell("", "data nojob.toml", lost).exit_code, 2) << lost;
    EXPECT_EQ(shell("", "no_command", lost).exit_code, 2) << lost;
    EXPECT_EQ(shell("", "calibrate job.toml --progress -o there", lost).exit_code,
              std::string(lost).find(">&- 2") == std::string::npos ? 0 : 3)
        << lost;
    EXPECT_TRUE(fs::exists(directory.path("there/calibration.json"))) << lost;
    fs::remove_all(directory.path("there"));
  }
}

TEST_F(Streams, ThatAreClosedAreNoFilesOfAResult) {
  ASSERT_EQ(frictab({"calibrate", "job.toml", "-o", "whole"}).exit_code, 0);
  ASSERT_EQ(shell("", "calibrate job.toml -v -o there", " <&- >&- 2>&-").exit_code, 3);
  EXPECT_EQ(run_command({"diff", "-r", "whole", "there"}, directory.path()).out, "");
}

TEST_F(Streams, ThatNobodyReadsAreNoFault) {
  for (const char* arguments : {"explain job", "list models", "status job.toml", "help run"}) {
    const CommandResult result =
        shell("{", arguments, "; echo $? >code; } 2>said | head -c 1 >/dev/null");
    EXPECT_EQ(directory.read("code"), "0\n") << arguments;
    EXPECT_EQ(directory.read("said"), "") << arguments;
  }
}

TEST_F(Streams, BeyondALimitOfFilesNothingIsLeft) {
  const CommandResult result = shell("ulimit -f 8;", "run job.toml -q", "");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("error: cannot write "));
  EXPECT_THAT(result.err, HasSubstr("File too large"));
  EXPECT_FALSE(fs::exists(directory.path("out")));
}

TEST_F(Streams, AStackThatIsTooSmallIsNamed) {
  const CommandResult result = shell("ulimit -s 128;", "calibrate job.toml", "");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("error: the stack is limited to 128.0 KiB"));
  EXPECT_THAT(result.err, HasSubstr("ulimit -s 8192"));
}

TEST_F(Streams, ALinkThatLeadsToItselfIsAFaultOfTheUser) {
  fs::create_symlink("loop", directory.path("loop"));
  for (const char* arguments :
       {"data loop", "calibrate job.toml -o loop", "data job.toml -o loop/x",
        "calibrate job.toml --set data.training=loop", "export --table loop --targets c -o there",
        "init loop"}) {
    const CommandResult result = shell("", arguments, "");
    EXPECT_EQ(result.exit_code, 2) << arguments << result.err;
    EXPECT_THAT(result.err, HasSubstr("loop")) << arguments;
  }
}

} // namespace
} // namespace frictab::streams_test
