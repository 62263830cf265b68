// `export --combine` and `verify --combined` as a user meets them.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "codegen/compile.h"
#include "support/json.h"
#include "support/run_command.h"
#include "support/sample_tables.h"
#include "table/table_file.h"

namespace frictab::combine_command_test {

namespace {

using test::CommandResult;
using test::run_frictab;
using testing::HasSubstr;

// tau_R = mu p, known to drift by 0.2 MPa from its law.
table::Table coulomb(const std::string& model, double mu) {
  table::Table table = test::constant_table();
  table.model = model;
  table.value = {mu};
  table.record.tolerance_MPa = 0.5;
  table.record.worst_case_MPa = 0.2;
  table.record.inputs["sigma_n_MPa"] = {.low = 500, .high = 2500};
  return table;
}

class CombineCommand : public testing::Test {
protected:
  void SetUp() override {
    for (const char* folder : {"a", "b"})
      std::filesystem::create_directory(directory.path(folder));
    table::write_table(coulomb("oil", 0.08), directory.path("a/oil.h5"));
    table::write_table(coulomb("soap", 0.04), directory.path("b/soap.h5"));
  }
  CommandResult run(std::vector<std::string> arguments) const {
    return run_frictab(arguments, directory.path());
  }
  // What `export --combine` of these laws answers.
  CommandResult combine(const std::vector<std::string>& laws,
                        const std::vector<std::string>& further) const {
    std::vector<std::string> arguments = {"export", "--combine"};
    arguments.insert(arguments.end(), laws.begin(), laws.end());
    arguments.insert(arguments.end(), further.begin(), further.end());
    return run(arguments);
  }
  test::TemporaryDirectory directory;
};

const std::vector<std::string> both = {"PUNCH=a/oil.h5", "DIE=b/soap.h5"};

TEST_F(CombineCommand, WritesAUserFileThatVerifyProvesUntilSomebodySwapsTheLaws) {
  if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  const CommandResult made = combine(both, {"--targets", "abaqus_fric", "-o", "user"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(made.out, "user/abaqus_fric/README.md\nuser/abaqus_fric/frictab.inp\n"
                      "user/abaqus_fric/frictab_cae.py\nuser/abaqus_fric/frictab_fric.f\n"
                      "user/abaqus_fric/recipe.json\n");
  const auto recipe = test::parse_json(directory.read("user/abaqus_fric/recipe.json"));
  EXPECT_EQ(recipe.at("laws")[1].at("name"), "DIE");
  EXPECT_EQ(recipe.at("laws")[1].at("table_file"), "../../b/soap.h5");

  const CommandResult proof = run({"verify", "--combined", "user"});
  EXPECT_EQ(proof.exit_code, 0) << proof.err;
  EXPECT_THAT(proof.out, testing::ContainsRegex("PUNCH: oil .*<= 0\\.2  ok\n"));
  EXPECT_THAT(proof.out, testing::ContainsRegex("DIE: soap .*<= 0\\.2  ok\n"));
  EXPECT_EQ(run({"verify", "--combined", "user", "--max-drift-MPa", "0.1"}).exit_code, 1)
      << "with the table's own drift";

  std::string source = directory.read("user/abaqus_fric/frictab_fric.f");
  source.replace(source.find("call f1fric"), 11, "call f2fric");
  directory.write("user/abaqus_fric/frictab_fric.f", source);
  const CommandResult swapped = run({"verify", "--combined", "user"});
  EXPECT_EQ(swapped.exit_code, 1);
  EXPECT_THAT(swapped.out, testing::ContainsRegex("PUNCH: oil .*OVER TOLERANCE\n"));
  EXPECT_THAT(swapped.out, testing::ContainsRegex("DIE: soap .*ok\n"));
}

TEST_F(CombineCommand, SaysWhatIsWrongWithItsLaws) {
  const auto fault = [&](const std::vector<std::string>& laws, const std::string& target) {
    const CommandResult result = combine(laws, {"--targets", target, "-o", "user"});
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_THAT(fault({"PUNCH"}, "abaqus_fric"),
              HasSubstr("--combine takes NAME=TABLE, not 'PUNCH'"));
  EXPECT_THAT(fault({"A=a/oil.h5", "a=b/soap.h5"}, "abaqus_fric"), HasSubstr("two laws for 'a'"));
  EXPECT_THAT(fault({"A=a/none.h5"}, "abaqus_fric"), HasSubstr("a/none.h5"));
  EXPECT_THAT(fault(both, "c"), HasSubstr("c has no routine to combine: give each law names"));
  EXPECT_THAT(fault(both, "abaqus_table"),
              HasSubstr("the solver's own tables are one per contact"));
  EXPECT_THAT(fault(both, "calculix_usrmu"), HasSubstr("do not say which contact it is"));
  EXPECT_THAT(fault(both, "lsdyna_usrfrc"), HasSubstr("'PUNCH' is not a number"));
  EXPECT_THAT(combine(both, {"--targets", "abaqus_fric"}).err, HasSubstr("give -o DIR"));
  EXPECT_THAT(run({"verify", "--combined", "a"}).err, HasSubstr("there are no combined sources"));
}

TEST_F(CombineCommand, TakesWhatHoldsForAllLawsFromAJob) {
  directory.write("job.toml", "[data]\ntraining = \"x.csv\"\n[export]\n"
                              "targets = [\"marc_ufric\"]\nunits = \"m-kg-s\"\n"
                              "[export.options]\nmarc_dimension = \"3d\"\n");
  const CommandResult made =
      run({"export", "job.toml", "-o", "user", "--combine", "2=a/oil.h5", "3=b/soap.h5"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string source = directory.read("user/marc_ufric/frictab_ufric.f");
  EXPECT_THAT(source, HasSubstr("vrel(2)"));
  EXPECT_THAT(source, HasSubstr("if (nsurf .eq. 3) then"));
  if (have_program("gfortran")) {
    EXPECT_EQ(run({"verify", "--combined", "user"}).exit_code, 0);
  }
}

} // namespace

} // namespace frictab::combine_command_test
