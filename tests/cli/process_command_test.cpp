// frictab process: a simulation's contact states in; where it rubs, what laws do to its force and
// which tests would settle it out. The histories are those of examples/12_process (SYNTHETIC).
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file_streams.h"
#include "support/run_command.h"

namespace frictab::process_command_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

std::string example(const std::string& file) {
  return std::string(FRICTAB_SOURCE_DIR) + "/examples/12_process/" + file;
}

// A small campaign of the twin with three laws, calibrated once.
class ProcessCommand : public testing::Test {
protected:
  static void SetUpTestSuite() {
    directory = new TemporaryDirectory;
    ASSERT_EQ(run_frictab({"twin", directory->path(), "--force", "--design",
                           "v=50,200;T=20,120;points=40;validation=6"})
                  .exit_code,
              0);
    ASSERT_EQ(run({"calibrate", "job.toml", "-q"}).exit_code, 0);
  }
  static void TearDownTestSuite() { delete directory; }

  static CommandResult run(std::vector<std::string> arguments) {
    for (const char* more : {"--set", "models.use=[\"coulomb\", \"log_coulomb\", \"polynomial\"]"})
      arguments.emplace_back(more);
    return run_frictab(std::move(arguments), directory->path());
  }
  static CommandResult ring(std::vector<std::string> more = {}, const std::string& symmetry = "2") {
    std::vector<std::string> arguments = {"process",
                                          "job.toml",
                                          example("ring/contact.csv"),
                                          "--tool",
                                          example("ring/tool.csv"),
                                          "--used",
                                          "coulomb:0.08",
                                          "--symmetry",
                                          symmetry};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  static inline TemporaryDirectory* directory = nullptr;
};

TEST_F(ProcessCommand, SaysWhereItRubsWhatLawsDoAndWhichTestsSettleIt) {
  const CommandResult result = ring();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* line :
       {"\nIn short:\n  SYNTHETIC tests\n  read: 1,657 contacts at 46 increments of 37 facets; "
        "friction takes 9 % of the tool's work, +1.7 % against the solver's own sum\n",
        "\n  where: ", " of the friction work is thinly tested", "\n  laws: ", "\n  take: ",
        " of force (a rerun: ", "\n  next: run 4 tests of process_plan.csv", "\n  out of reach: ",
        "Wrote 4 files to out: process.html, process.json, process_plan.csv, "
        "stages.json\nnext: open out/process.html\n"})
    EXPECT_THAT(result.out, HasSubstr(line));
  EXPECT_THAT(result.out, Not(HasSubstr("Laws by mean absolute error")));
}

TEST_F(ProcessCommand, WritesWhatItSaysAsJsonAndAsAPage) {
  ASSERT_EQ(ring({"-q"}).exit_code, 0);
  const Json json = Json::parse(directory->read("out/process.json"));
  EXPECT_EQ(json["schema"], "frictab/process/1");
  EXPECT_EQ(json["prediction"], "force");
  EXPECT_NEAR(json["work_check_percent"].get<double>(), 1.7, 0.1);
  EXPECT_EQ(json["assessment"]["laws"].size(), 3u);
  for (const Json& law : json["assessment"]["laws"])
    EXPECT_EQ(law["force_kN"].size(), json["time_s"].size());
  EXPECT_EQ(json["next"]["tests"].size(), 4u);
  const std::string page = directory->read("out/process.html");
  for (const char* part : {"The laws in your process", "<svg", "Synthetic data",
                           "Tests that would settle it", "what not to conclude"})
    EXPECT_THAT(page, HasSubstr(part));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

TEST_F(ProcessCommand, LawOfTheSimulationChangesNothing) {
  std::string text = io::read_file(example("ring/contact.csv"));
  text.replace(text.find("tau_R_MPa"), 9, "other_MPa"); // of another law
  directory->write("own.csv", text);
  const CommandResult result =
      run({"process", "job.toml", "own.csv", "--used", "coulomb", "--json", "-q"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Json process = Json::parse(result.out)["process"];
  for (const Json& law : process["assessment"]["laws"])
    if (law["law"] == "coulomb") {
      EXPECT_NEAR(law["late_percent"].get<double>(), 0, 0.01);
    }
}

TEST_F(ProcessCommand, HalfOfTheAreasIsAFaultAndNothingIsWritten) {
  ASSERT_EQ(ring({"-q"}).exit_code, 0);
  const std::string before = directory->read("out/process.json");
  const CommandResult result = ring({}, "1");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--symmetry 2?"));
  EXPECT_EQ(directory->read("out/process.json"), before);
}

TEST_F(ProcessCommand, MistypedColumnIsAFaultWithItsPlace) {
  std::string text = io::read_file(example("ring/contact.csv"));
  text.replace(text.find("sigma_n_MPa"), 11, "sigma_m_MPa");
  directory->write("typed.csv", text);
  const CommandResult result = run({"process", "job.toml", "typed.csv", "--used", "coulomb:0.08"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("typed.csv"));
  EXPECT_THAT(result.err, HasSubstr("there is no column sigma_n_MPa"));
}

TEST_F(ProcessCommand, WithoutContactOrLawSaysWhatIsMissing) {
  CommandResult result = run({"process", "job.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("no CONTACT is given"));
  std::string text = io::read_file(example("ring/contact.csv"));
  text.replace(text.find("tau_R_MPa"), 9, "other_MPa");
  directory->write("other.csv", text);
  result = run({"process", "job.toml", "other.csv"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("neither the law of the simulation nor its shear stress"));
}

TEST_F(ProcessCommand, MissingTemperatureIsHeldAndPriced) {
  std::string text = io::read_file(example("ring/contact.csv"));
  text.replace(text.find("T_contact_C"), 11, "T_somewhere");
  directory->write("cold.csv", text);
  const CommandResult result =
      run({"process", "job.toml", "cold.csv", "--tool", example("ring/tool.csv"), "--used",
           "coulomb:0.08", "--symmetry", "2"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, testing::ContainsRegex("held: T [0-9.]+ degC everywhere \\(the median of "
                                                 "the tests\\), between .* up to .* % of force"));
}

TEST_F(ProcessCommand, MayStandInTheJobAndRunsAfterTheRest) {
  const std::string job = directory->read("job.toml") +
                          fmt::format("\n[process]\ncontact = \"{}\"\ntool = \"{}\"\n"
                                      "used = \"coulomb:0.08\"\nsymmetry = 2\nresamples = 5\n",
                                      example("rod/contact.csv"), example("rod/tool.csv"));
  std::string one = job;
  one.replace(one.find("symmetry = 2"), 12, "symmetry = 1");
  directory->write("with.toml", one);
  const CommandResult plan = run({"run", "with.toml", "--dry-run", "-o", "whole"});
  EXPECT_THAT(plan.out, HasSubstr("process"));
  const CommandResult result = run({"process", "with.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("friction takes 45 % of the tool's work"));
  directory->write("wrong.toml", job);
  EXPECT_EQ(run({"process", "wrong.toml"}).exit_code, 2);
}

TEST_F(ProcessCommand, KeysOfTheJobAreChecked) {
  directory->write("faults.toml",
                   "[data]\ntraining = \"training.csv\"\n[process]\n"
                   "contact = \"c.csv\"\ndriven = \"hand\"\nsymetry = 2\n"
                   "[process.columns]\nsigma_n_MPa = { unit = \"mm\" }\n"
                   "[process.rig]\npsi = [0.5, 3]\n[process.constants]\npsi = 0.2\n");
  const CommandResult result = run_frictab({"process", "faults.toml"}, directory->path());
  EXPECT_EQ(result.exit_code, 2);
  for (const char* fault :
       {"did you mean 'symmetry'?", "process.driven", "does not convert to MPa",
        "process.rig.psi starts at 0.5: too low", "process.constants.psi is 0.2"})
    EXPECT_THAT(result.err, HasSubstr(fault));
}

TEST_F(ProcessCommand, TestsThatWereRunShowBeforeAndAfter) {
  // Tests at the settings of the campaign's own, as they come from the rig.
  ASSERT_EQ(run_frictab({"twin", directory->path("more"), "--force", "--seed", "9", "--design",
                         "p=1725;psi=1;v=50;T=20;points=40;validation=1"})
                .exit_code,
            0);
  std::string text = directory->read("more/training.csv");
  directory->write("added.csv", text);
  const CommandResult result = ring({"--add", "added.csv"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\n  now: with 1 test more: "));
  EXPECT_THAT(result.out, HasSubstr("\n  before: "));
  EXPECT_TRUE(Json::parse(directory->read("out/process.json")).contains("with_added"));
}

TEST_F(ProcessCommand, PrintsScriptsThatWriteItsFiles) {
  for (const char* solver : {"abaqus", "calculix", "getfem", "lsdyna", "deform"}) {
    const CommandResult result = run_frictab({"process", "--script", solver});
    EXPECT_EQ(result.exit_code, 0) << solver;
    EXPECT_THAT(result.out, HasSubstr("contact.csv")) << solver;
  }
  EXPECT_EQ(run_frictab({"process", "--script", "ansis"}).exit_code, 2);
}

TEST_F(ProcessCommand, IsExplainedWithItsColumns) {
  const CommandResult result = run_frictab({"explain", "process"});
  EXPECT_EQ(result.exit_code, 0);
  for (const char* word : {"area_mm2", "slip_1_mm", "friction_J", "--script"})
    EXPECT_THAT(result.out, HasSubstr(word));
}

} // namespace
} // namespace frictab::process_command_test
