// `export --check`: the exported sources compile on their own, or the command says which does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/program.h"
#include "support/run_command.h"

namespace frictab::check_command_test {

namespace {

using test::CommandResult;
using testing::HasSubstr;

class CheckCommand : public testing::Test {
protected:
  CommandResult run(const std::vector<std::string>& arguments,
                    const std::vector<std::string>& environment = {}) const {
    return test::run_frictab(arguments, directory.path(), environment);
  }
  CommandResult make(const std::string& targets) const {
    return run({"export", "--law", "coulomb", "--param", "mu=0.08", "-o", "out", "--targets",
                targets, "--check"});
  }
  test::TemporaryDirectory directory;
};

TEST_F(CheckCommand, CompilesWhatIsExportedAndNamesTheSourceThatDoesNotCompile) {
  if (!have_program("gfortran") || !have_program("gcc")) GTEST_SKIP() << "no compilers";
  const CommandResult made = make("c,fortran,abaqus_vfric,abaqus_fric,lsdyna_usrfrc");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  for (const char* line : {"out/abaqus_vfric/frictab_vfric.f: compiled by gfortran\n",
                           "out/abaqus_fric/frictab_fric.f: compiled by gfortran\n",
                           "out/lsdyna_usrfrc/frictab_usrfrc.f: compiled by gfortran\n",
                           "out/fortran/frictab_tau_R.f90: compiled by gfortran\n",
                           "out/c/frictab_tau_R.c: compiled by gcc\n"})
    EXPECT_THAT(made.out, HasSubstr(line));
  const std::string source = "out/abaqus_vfric/frictab_vfric.f";
  directory.write(source, directory.read(source) + "      this is no statement(\n");
  const CommandResult broken = run({"export", "--check", "-o", "out"});
  EXPECT_EQ(broken.exit_code, 1);
  EXPECT_THAT(broken.out, HasSubstr(source + ": does not compile:"));
  EXPECT_THAT(broken.out, HasSubstr("out/abaqus_fric/frictab_fric.f: compiled by gfortran\n"));
}

TEST_F(CheckCommand, SaysWhatIsMissing) {
  make("abaqus_vfric");
  const CommandResult without = run({"export", "--check", "-o", "out"}, {"PATH=/nowhere"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.err, HasSubstr("there is no compiler: gfortran, ifort, ifx"));
  EXPECT_THAT(without.err, HasSubstr("hint: Debian: apt-get install gfortran"));
  directory.write("empty/notes.txt", "");
  const CommandResult empty = run({"export", "--check", "-o", "empty"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.err, HasSubstr("there are no exported sources"));
}

TEST_F(CheckCommand, LetsTablesOfSolversBe) {
  const CommandResult made = make("lsdyna_table");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("out: nothing to compile\n"));
}

} // namespace

} // namespace frictab::check_command_test
