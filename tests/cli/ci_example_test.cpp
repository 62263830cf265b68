// The CI example: its script as a pipeline calls it, its pipelines as they call the script.
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file_streams.h"
#include "support/small_campaign.h"

namespace frictab::ci_example_test {
namespace {

using test::CommandResult;
using testing::HasSubstr;

const std::string folder = FRICTAB_SOURCE_DIR "/examples/04_ci_pipeline/";

class CiExample : public test::SmallCampaign {
protected:
  CommandResult step(const std::string& allowed) const {
    return test::run_command(
        {"sh", folder + "verify.sh", "out", "data/validation.csv", "levanov", allowed},
        directory.path(), {"FRICTAB=" + test::program()});
  }
};

TEST_F(CiExample, PassesAndFailsByTheExitCodeAndLeavesTheFigures) {
  write_job("[models]\nuse = [\"levanov\"]\n");
  ASSERT_EQ(frictab({"tabulate", "-q"}).exit_code, 0);
  EXPECT_EQ(step("0.5").exit_code, 0);
  EXPECT_THAT(directory.read("out/junit.xml"), HasSubstr("<property name=\"worst_case_MPa\""));
  EXPECT_EQ(step("1e-6").exit_code, 1);
  EXPECT_THAT(directory.read("out/junit.xml"), HasSubstr("<failure message=\"worst case "));
}

TEST_F(CiExample, OfBothSystemsCallsTheScriptAndKeepsItsFile) {
  for (const char* pipeline : {"gitlab-ci.yml", "github-workflow.yml"}) {
    const std::string text = io::read_file(folder + pipeline);
    EXPECT_TRUE(std::regex_search(
        text, std::regex("sh examples/04_ci_pipeline/verify\\.sh \\S+ \\S+ \\S+ [0-9.]+\n")))
        << pipeline;
    EXPECT_THAT(text, HasSubstr("friction/out/junit.xml")) << pipeline;
  }
}

} // namespace
} // namespace frictab::ci_example_test
