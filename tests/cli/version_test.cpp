// The version of the program and of what it writes: its release and commit.
#include <filesystem>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/small_campaign.h"

namespace frictab::version_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_command;
using test::run_frictab;
using testing::HasSubstr;
using testing::MatchesRegex;

// The last word of `--version`, which is checked.
std::string version() {
  const CommandResult told = run_frictab({"--version"});
  EXPECT_TRUE(
      std::regex_match(told.out, std::regex("frictab 0\\.2\\.0(\\+g[0-9a-f]{7,40}(\\.dirty)?)?\n")))
      << told.out;
  return told.out.substr(8, told.out.size() - 9);
}

class Version : public test::SmallCampaign {};

TEST_F(Version, StandsInEveryFileThatIsWritten) {
  const std::string here = version();
  write_job("[models]\nuse = [\"coulomb\"]\n[export]\ntargets = \"all\"\n");
  ASSERT_EQ(frictab({"calibrate", "-q"}).exit_code, 0);
  ASSERT_EQ(frictab({"export", "-q"}).exit_code, 0);
  for (const char* file : {"calibration.json", "models/coulomb.json", "stages.json"})
    EXPECT_EQ(nlohmann::json::parse(directory.read(std::string("out/") + file)).at("tool_version"),
              here)
        << file;
  EXPECT_THAT(frictab({"table", "info", "out/tables/coulomb.h5"}).out, HasSubstr(here));
  std::size_t recipes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory.path("out/export")))
    if (entry.path().filename() == "recipe.json") {
      const std::string recipe = fs::relative(entry.path(), directory.path()).string();
      EXPECT_EQ(nlohmann::json::parse(directory.read(recipe)).at("tool_version"), here) << recipe;
      ++recipes;
    }
  EXPECT_GE(recipes, 10U);
}

// Of a repository of its own, through the script that the build runs.
class VersionScript : public testing::Test {
protected:
  void SetUp() override {
    if (run_command({"git", "--version"}).exit_code != 0) GTEST_SKIP() << "git is not installed";
    directory.write("src/core/commit.txt", "$Format:%h$\n");
    directory.write("README.md", "one\n");
  }
  void shell(const std::string& command) const {
    const CommandResult result =
        run_command({"sh", "-ec", command}, directory.path(),
                    {"GIT_CONFIG_GLOBAL=/dev/null", "GIT_CONFIG_SYSTEM=/dev/null"});
    ASSERT_EQ(result.exit_code, 0) << command << result.err;
  }
  void commit() const {
    shell("git init -q . 2>/dev/null; git add -A; "
          "git -c user.name=a -c user.email=a@b commit -q -m x");
  }
  std::string made(const std::string& root = ".") const {
    const CommandResult result =
        run_command({"cmake", "-DOUT=" + directory.path(".git-ignored/version.cpp"),
                     "-DROOT=" + directory.path(root), "-DRELEASE=1.2.3", "-P",
                     FRICTAB_SOURCE_DIR "/src/core/version.cmake"},
                    directory.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string text = directory.read(".git-ignored/version.cpp");
    const std::size_t at = text.find("return \"") + 8;
    return text.substr(at, text.find('"', at) - at);
  }
  test::TemporaryDirectory directory;
};

TEST_F(VersionScript, NamesTheCommitAndSaysWhereFilesWereChangedSince) {
  EXPECT_EQ(made(), "1.2.3") << "no repository";
  commit();
  EXPECT_THAT(made(), MatchesRegex("1\\.2\\.3\\+g[0-9a-f]+"));
  directory.write("README.md", "two\n");
  EXPECT_THAT(made(), MatchesRegex("1\\.2\\.3\\+g[0-9a-f]+\\.dirty"));
}

TEST_F(VersionScript, LeavesItsFileAloneWhereNothingChanged) {
  commit();
  const std::string first = made();
  const auto before = fs::last_write_time(directory.path(".git-ignored/version.cpp"));
  EXPECT_EQ(made(), first);
  EXPECT_EQ(fs::last_write_time(directory.path(".git-ignored/version.cpp")), before);
}

TEST_F(VersionScript, TakesTheCommitOfAnArchiveAndNotThatOfARepositoryAroundIt) {
  directory.write("inner/src/core/commit.txt", "$Format:%h$\n");
  commit();
  EXPECT_EQ(made("inner"), "1.2.3");
  directory.write("inner/src/core/commit.txt", "0123abc\n"); // as git archive leaves it
  EXPECT_EQ(made("inner"), "1.2.3+g0123abc");
}

} // namespace
} // namespace frictab::version_test
