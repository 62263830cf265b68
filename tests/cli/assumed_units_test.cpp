// Units that nobody gave, and files in other units than the others, as a user meets them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"

namespace frictab::assumed_units_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class AssumedUnits : public testing::Test {
protected:
  // Ten tests of a rig that writes forces, the normal one `scale` times as large in some files.
  void write(const std::string& job, const std::string& force, double factor, double scale = 1,
             int from = 1, int to = 0) {
    for (int test = 1; test <= 10; ++test) {
      std::string text = fmt::format("Zeit [s],{},Friction [{}],v_rel_mm_s,T_contact_C\n", force,
                                     factor == 1 ? "N" : "kN");
      for (int i = 0; i <= 40; ++i) {
        const double load = (40000 + 8000 * (test % 4) + 20 * i) * factor;
        const double by = test >= from && test <= to ? scale : 1;
        text += fmt::format("{:.2f},{:.6g},{:.6g},{},{}\n", 0.1 * i, load * by,
                            load * by * (0.1 + 0.001 * test + 0.0005 * (i % 3)),
                            10 + 5 * (test % 3), 20 + 0.5 * i + test % 2);
      }
      directory.write(fmt::format("rig/K{}.csv", test), text);
    }
    directory.write("job.toml", "[data]\ntraining = \"rig\"\nexperiment = \"file\"\n" + job);
  }

  CommandResult data(const std::string& set = "") {
    std::vector<std::string> words = {"data", "job.toml"};
    if (!set.empty()) words.insert(words.end(), {"--set", set});
    return run_frictab(words, directory.path());
  }

  const std::string columns = "[data.columns]\ntime_s = \"Zeit\"\nF_N_N = \"Load\"\n"
                              "F_R_N = \"Friction\"\n"
                              "sigma_n_MPa = { column = \"Load\", area_mm2 = 78.54 }\n";
  TemporaryDirectory directory;
};

// A friction force in N beside it tells that the load is in N as well.
TEST_F(AssumedUnits, AreNotAskedForWhereTheCoefficientTells) {
  write(columns, "Load", 1);
  const CommandResult result = data();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("read: no unit is given for Load (N)"),
                                Not(HasSubstr("unit not given"))));
}

TEST_F(AssumedUnits, AreAnErrorBesideTheFlowStressWhereAnotherOneFits) {
  std::string job = columns + "[data.constants]\nsigma_f_MPa = 400\n";
  write(job, "Load", 1e-3);
  for (int test = 1; test <= 10; ++test) { // nobody gave the friction force's either
    const std::string file = fmt::format("rig/K{}.csv", test);
    std::string text = directory.read(file);
    text.replace(text.find("Friction [kN]"), 13, "Friction");
    directory.write(file, text);
  }
  for (const char* command : {"data", "run"}) {
    const CommandResult result = run_frictab({command, "job.toml"}, directory.path());
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err,
                AllOf(HasSubstr("at a flow stress sigma_f_MPa of 400"),
                      HasSubstr("'Load', taken as N: sigma_n_MPa is 0.5"), HasSubstr("in kN 51"),
                      HasSubstr("allow_implausible = [\"flow_stress\"]")));
  }
  EXPECT_THAT(data().out, HasSubstr("unit not given: no unit is given for 'Load'"));
  EXPECT_THAT(directory.read("out/data.html"), HasSubstr("unit not given: "));
  const auto json =
      test::parse_json(run_frictab({"data", "job.toml", "--json"}, directory.path()).out);
  EXPECT_THAT(json.at("units_not_given").at(0).get<std::string>(), HasSubstr("in kN"));

  const CommandResult allowed = data("data.allow_implausible=[\"flow_stress\"]");
  EXPECT_EQ(allowed.exit_code, 0) << allowed.err;
  EXPECT_THAT(allowed.out, HasSubstr("implausible: sigma_n_MPa is 0.5"));
}

TEST_F(AssumedUnits, AreGivenByTheJob) {
  std::string job = columns;
  job.replace(job.find("\"Load\", area"), 6, "\"Load\", unit = \"N\"");
  write(job, "Load", 1);
  EXPECT_THAT(data().out, Not(HasSubstr("unit not given")));
}

TEST_F(AssumedUnits, OfAFileAmongOthersAreNamed) {
  write(columns, "Load [N]", 1, 1e-3, 4, 4);
  const CommandResult one = data();
  EXPECT_EQ(one.exit_code, 2);
  EXPECT_THAT(one.err, AllOf(HasSubstr("test 'K4' (rig/K4.csv)"), HasSubstr("F_N_N in kN")));
  EXPECT_EQ(data("data.allow_implausible=[\"mixed_units\"]").exit_code, 0);

  write(columns, "Load [N]", 1, 1e-3, 1, 5);
  EXPECT_THAT(data().err, AllOf(HasSubstr("tests 'K1', 'K2', 'K3' (and 2 more tests)"),
                                HasSubstr("F_N_N in kN"), HasSubstr("(205 of 410 rows)")));
}

TEST_F(AssumedUnits, OfValidationFilesAreComparedWithTrainingFiles) {
  write(columns, "Load [N]", 1, 1e-3, 8, 10);
  directory.write("job.toml",
                  "[data]\ntraining = \"rig/K[1-7].csv\"\nvalidation = [\"rig/K8.csv\", "
                  "\"rig/K9.csv\", \"rig/K10.csv\"]\nexperiment = \"file\"\n" +
                      columns);
  const CommandResult result = data();
  EXPECT_EQ(result.exit_code, 2) << result.out;
  EXPECT_THAT(result.err, HasSubstr("'K8'"));
}

TEST_F(AssumedUnits, AreAskedForByInit) {
  write("", "Normal force", 1);
  const CommandResult result =
      run_frictab({"init", "--from", "rig/K1.csv", "rig/K2.csv", "--force"}, directory.path());
  const std::string all = result.out + result.err + directory.read("job.toml");
  EXPECT_THAT(all, AllOf(HasSubstr("? In which units?"), HasSubstr("Normal force (N)"),
                         HasSubstr("unit = \"kN\" }"), HasSubstr("or N, kgf, lbf, mN")));
}

} // namespace
} // namespace frictab::assumed_units_test
