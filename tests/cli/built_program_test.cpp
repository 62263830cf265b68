// The program as it was built: what it loads, what it starts, and what its bytes say.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/program.h"
#include "io/file_streams.h"
#include "support/hardened.h"
#include "support/json.h"
#include "support/run_command.h"

namespace frictab::built_program_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_frictab;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(BuiltProgram, HasTheProtectionsOfItsCompilerAndNoPathToLibraries) {
  if (!have_program("readelf")) GTEST_SKIP() << "readelf is not installed";
  EXPECT_THAT(test::protections_missing_in(test::program()), IsEmpty());
}

TEST(BuiltProgram, LoadsNoLibraryOfTheWorkingDirectory) {
  const test::TemporaryDirectory directory;
  std::size_t planted = 0;
  for (const auto& item : test::parse_json(run_frictab({"doctor", "--json"}).out))
    if (const std::string name = item.at("name"); name.find(".so") != name.npos) {
      directory.write(name, "not a library: to load it is an error");
      ++planted;
    }
  EXPECT_GT(planted, 15u);
  const CommandResult ran = run_frictab({"--version"}, directory.path());
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

// Two folders then give the same bytes (.ci/reproducible builds in both).
TEST(BuiltProgram, DoesNotNameTheFoldersThatItWasBuiltIn) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "reports of sanitizers name files";
#endif
  const std::string bytes = io::read_file(test::program());
  for (const std::string& folder :
       {std::string(FRICTAB_SOURCE_DIR), fs::path(test::program()).parent_path().string()})
    EXPECT_EQ(bytes.find(folder), bytes.npos) << folder;
}

class CompilersInTheWay : public testing::Test {
protected:
  void SetUp() override {
    if (!have_program("gcc") || !have_program("gfortran")) GTEST_SKIP() << "no compilers";
    for (const char* name : {"gcc", "gfortran", "as", "ld", "cc1", "f951", "collect2", "sh"})
      plant(directory, name, "echo planted >> '" + directory.path("started") + "'\nexit 1\n");
  }
  static void plant(const test::TemporaryDirectory& directory, const std::string& name,
                    const std::string& script) {
    fs::permissions(directory.write(name, "#!/bin/sh\n" + script), fs::perms::owner_all);
  }
  CommandResult check(const std::vector<std::string>& environment) const {
    return run_frictab({"export", "--law", "coulomb", "--param", "mu=0.08", "-o", "out",
                        "--targets", "c,fortran", "--check", "--force"},
                       directory.path(), environment);
  }
  test::TemporaryDirectory directory;
};

TEST_F(CompilersInTheWay, AreNotStartedFromTheWorkingDirectory) {
  const std::string path = std::getenv("PATH"), here = directory.path();
  for (const std::vector<std::string>& environment :
       {std::vector{"PATH=.:" + path},
        {"PATH=:" + path},
        {"PATH=" + here + ":" + path},
        {"PATH=" + path, "COMPILER_PATH=.", "GCC_EXEC_PREFIX=./"}}) {
    const CommandResult made = check(environment);
    EXPECT_EQ(made.exit_code, 0) << environment.front() << made.out << made.err;
    EXPECT_THAT(made.out, HasSubstr("out/c/frictab_tau_R.c: compiled by gcc\n"));
    EXPECT_FALSE(fs::exists(directory.path("started"))) << environment.front();
  }
  const CommandResult none = check({"PATH=.:" + here});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, HasSubstr("there is no compiler: gcc, clang"));
  EXPECT_THAT(none.err, HasSubstr("hint: Debian: apt-get install gfortran gcc"));
  EXPECT_FALSE(fs::exists(directory.path("started")));
}

TEST_F(CompilersInTheWay, AreStoppedAfterTheirTimeWithTheVariableThatGivesMore) {
  const test::TemporaryDirectory slow; // a folder of the user's own
  plant(slow, "gcc", "exec sleep 77\n");
  const CommandResult made =
      check({"PATH=" + slow.path() + ":" + std::getenv("PATH"), "FRICTAB_COMPILE_SECONDS=1"});
  EXPECT_EQ(made.exit_code, 1);
  EXPECT_THAT(made.out, HasSubstr("\ndid not end within 1 s and was stopped; "
                                  "FRICTAB_COMPILE_SECONDS=N in the environment allows N s\n"));
  const CommandResult wrong = check({"FRICTAB_COMPILE_SECONDS=soon"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err,
              HasSubstr("FRICTAB_COMPILE_SECONDS: error: 'soon' is not a number above 0"));
}

} // namespace
} // namespace frictab::built_program_test
