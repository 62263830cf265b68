// Studies on the engines that people have: Slurm, started here on one machine, and Snakemake.
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <unistd.h>

#include "core/program.h"
#include "study/small_study.h"
#include "support/json.h"

namespace frictab::study_engines_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;

class SlowStudyOnEngines : public test::SmallStudy {
protected:
  void SetUp() override {
    SmallStudy::SetUp();
    directory.write("study.toml", test::twin_study(40));
  }
  // With the program on PATH.
  CommandResult run(const std::vector<std::string>& command) const {
    const std::string path =
        fs::path(test::program()).parent_path().string() + ":" + std::getenv("PATH") + ":/usr/sbin";
    return test::run_command(command, directory.path(), {"PATH=" + path});
  }
  void expect_whole(const std::string& results) const {
    EXPECT_EQ(test::parse_json(frictab({"study", "status", "--json", "-o", results}).out)["done"],
              40);
    ASSERT_EQ(frictab({"study", "run", "-j1", "-q", "-o", "whole"}).exit_code, 0);
    EXPECT_EQ(difference("whole/results", results + "/results"), "");
  }
};

TEST_F(SlowStudyOnEngines, SlurmHasEveryResultThoughAPartWasKilled) {
  if (!have_program("sbatch") || !have_program("/usr/sbin/slurmctld"))
    GTEST_SKIP() << "slurm-wlm is not installed";
  const int port = 20000 + 3 * static_cast<int>(::getpid() % 10000);
  const CommandResult result =
      run({FRICTAB_SOURCE_DIR "/tests/study/on_slurm", std::to_string(port)});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "n1\nn2\n");
  EXPECT_TRUE(fs::exists(directory.path("killed")));
  expect_whole("study");
}

TEST_F(SlowStudyOnEngines, SnakemakeRunsTheExample) {
  if (!have_program("snakemake")) GTEST_SKIP() << "snakemake is not installed";
  fs::copy(FRICTAB_SOURCE_DIR "/examples/11_study/Snakefile", directory.path("Snakefile"));
  directory.write("study.toml", "directory = \"out\"\n" + test::twin_study(40));
  const CommandResult result = run({"snakemake", "-j", "2", "--config", "shards=2", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_TRUE(fs::exists(directory.path("out/report.html")));
  expect_whole("out");
}

} // namespace
} // namespace frictab::study_engines_test
