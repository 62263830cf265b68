// The main job as a user runs it: files, exit codes, output, bad input, determinism.
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/file_streams.h"
#include "support/json.h"
#include "support/run_command.h"
#include "support/small_campaign.h"

namespace frictab::pipeline_test {
namespace {

namespace fs = std::filesystem;
using test::run_command;
using test::run_frictab;
using test::TemporaryDirectory;

// A small synthetic campaign: 16 experiments to train, 6 to validate, 40 rows each.
void write_campaign(const TemporaryDirectory& directory) {
  const auto result = run_frictab({"twin", directory.path("data"), "--seed", "3", "--design",
                                   "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=6"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
}

// Without the neural network, whose table takes most of a run's time: the bundled example has it.
const char* const job_text = R"([data]
training = "data/training.csv"
validation = "data/validation.csv"
[models]
use = ["coulomb_0.04", "coulomb_0.08", "shear_0.12", "coulomb_mean", "shear_mean", "orowan_mean",
       "coulomb", "shear", "orowan", "shaw", "wanheim_bay", "levanov", "log_coulomb", "exp_coulomb",
       "wzl"]
[table]
model = ["best", "levanov"]
[verify]
samples = 5000
)";
// A law with an effect in it comes out with this.
const char* const with_effect = "trace.ignore=[\"humidity_pct\", \"film_um\", \"Ra_um\", "
                                "\"tool\", \"run_order\", \"time_s\", \"s_mm\", \"T_tool_C\"]";

std::map<std::string, std::string> files_below(const std::string& directory) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), directory).string()] = io::read_file(entry.path());
  }
  return files;
}

class MainJob : public testing::Test {
protected:
  void SetUp() override {
    write_campaign(directory);
    job = directory.write("job.toml", std::string(job_text) + test::no_causes);
  }
  TemporaryDirectory directory;
  std::string job;
};

class SlowMainJob : public MainJob {
protected:
  // The results of `frictab run job`: made by the first test that asks, copied for the others.
  void run_job() const {
    static const TemporaryDirectory kept;
    if (!fs::exists(kept.path("out"))) {
      ASSERT_EQ(run_frictab({"run", job}).exit_code, 0);
      fs::copy(directory.path("out"), kept.path("out"), fs::copy_options::recursive);
      return;
    }
    fs::copy(kept.path("out"), directory.path("out"), fs::copy_options::recursive);
  }
};

TEST_F(MainJob, RunWritesEveryFileOfTheContractAndSaysNothingOnStderr) {
  const auto result = run_frictab({"run", job, "-q"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* part : {"SYNTHETIC data", "Laws by mean absolute error", "Tables:",
                           "Drift from the law", "Wrote ", "\nIn short (synthetic data):\n  take: ",
                           "\n  expect: ", "\n  effects: ", "\n  tested: ", "\n  FE files: "})
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  EXPECT_TRUE(result.out.ends_with("\nnext: open " + directory.path("out") + "/report.html\n"));
  EXPECT_EQ(result.out.find('\x1b'), std::string::npos) << "colours in a pipe";
  for (const char* file :
       {"calibration.json", "benchmark.md", "errors_by_experiment.csv", "models/coulomb.json",
        "models/wzl.json", "tables/levanov.h5", "export/c/levanov/recipe.json",
        "export/abaqus_vfric/levanov/recipe.json", "verify.json", "verify.xml", "report.html",
        "report.md"})
    EXPECT_TRUE(fs::exists(directory.path("out") + "/" + file)) << file;
}

TEST_F(SlowMainJob, SameJobGivesTheSameBytesForAnyNumberOfThreads) {
  for (const auto& [threads, out] : {std::pair("-j1", "one"), std::pair("-j2", "two")})
    ASSERT_EQ(run_frictab({"run", job, threads, "-o", directory.path(out), "--set", with_effect})
                  .exit_code,
              0);
  const auto one = files_below(directory.path("one")), two = files_below(directory.path("two"));
  ASSERT_GT(one.size(), 20U);
  ASSERT_EQ(one.size(), two.size());
  EXPECT_TRUE(one.count("export/c/exp_coulomb_traced/recipe.json"));
  for (const auto& [name, content] : one)
    EXPECT_TRUE(two.at(name) == content) << name;
}

// stages.json without the hashes of report.html and of its own content.
std::string without_hash_of_page(const std::string& stages) {
  return std::regex_replace(stages, std::regex("\"(report.html|content)\": \"[0-9a-f]{16}\""), "");
}

class LongMainJob : public SlowMainJob {};

TEST_F(LongMainJob, StagesOneByOneGiveTheSameFilesAsRun) {
  // Shaw's formula names the shear yield stress twice.
  const std::string models = R"(table.model=["best", "levanov", "shaw"])";
  ASSERT_EQ(
      run_frictab({"run", job, "--set", models, "--set", with_effect, "-o", directory.path("run")})
          .exit_code,
      0);
  for (const char* stage : {"calibrate", "trace", "tabulate", "export", "verify", "report"}) {
    const auto result = run_frictab(
        {stage, job, "--set", models, "--set", with_effect, "-o", directory.path("stages")});
    ASSERT_EQ(result.exit_code, 0) << stage << result.err;
  }
  const auto run = files_below(directory.path("run")),
             stages = files_below(directory.path("stages"));
  for (const auto& [name, content] : run) {
    if (name == "report.html") continue; // lists what its own command wrote
    ASSERT_TRUE(stages.count(name)) << name;
    if (name == "stages.json")
      EXPECT_EQ(without_hash_of_page(stages.at(name)), without_hash_of_page(content));
    else
      EXPECT_TRUE(stages.at(name) == content) << name;
  }
}

TEST_F(SlowMainJob, DriftOverToleranceIsExitCode1AndNamedInJUnit) {
  const std::vector<std::string> coarse = {"run",   job,
                                           "--set", "table.model=levanov",
                                           "--set", "table.axes.sigma_n_MPa.nodes=2",
                                           "--set", "table.axes.sigma_f_MPa.nodes=2"};
  const auto result = run_frictab(coarse);
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.out.find("OVER TOLERANCE"), std::string::npos) << result.out;
  const std::string xml = directory.read("out/verify.xml");
  EXPECT_NE(xml.find("<testcase classname=\"levanov\" name=\"table\">"), std::string::npos);
  EXPECT_NE(xml.find("<failure message=\"worst case "), std::string::npos) << xml;
}

TEST_F(MainJob, VerifyAloneChecksATableForAPipeline) {
  for (const char* stage : {"calibrate", "tabulate"})
    ASSERT_EQ(run_frictab({stage, job, "--set", "models.use=[\"coulomb\", \"levanov\"]", "--set",
                           "table.model=levanov"})
                  .exit_code,
              0);
  const std::vector<std::string> call = {"verify",
                                         "--table",
                                         directory.path("out/tables/levanov.h5"),
                                         "--model",
                                         directory.path("out/models/levanov.json"),
                                         "--data",
                                         directory.path("data/validation.csv"),
                                         "--junit",
                                         directory.path("ci/junit.xml"),
                                         "--max-drift-MPa"};
  auto strict = call, loose = call;
  strict.push_back("1e-6");
  loose.push_back("0.5");
  EXPECT_EQ(run_frictab(loose).exit_code, 0);
  const std::string passing = directory.read("ci/junit.xml");
  EXPECT_NE(passing.find("failures=\"0\""), std::string::npos);
  for (const char* figure : {"max_abs_MPa", "worst_case_MPa", "proven_MPa", "n_rows"})
    EXPECT_NE(passing.find(std::string("<property name=\"") + figure + "\" value=\""),
              std::string::npos)
        << figure;
  EXPECT_EQ(run_frictab(strict).exit_code, 1);
  EXPECT_NE(directory.read("ci/junit.xml").find("failures=\"1\""), std::string::npos);
}

TEST_F(SlowMainJob, VerifyRefusesATableOfAnotherLaw) {
  ASSERT_NO_FATAL_FAILURE(run_job());
  const auto result = run_frictab({"verify", "--table", directory.path("out/tables/levanov.h5"),
                                   "--model", directory.path("out/models/wzl.json")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(
      result.err.find("the law wzl needs v_rel_mm_s, which this table neither has as an axis"),
      std::string::npos)
      << result.err;
}

TEST_F(SlowMainJob, AFailedRunLeavesThePreviousResultsAsTheyWere) {
  ASSERT_NO_FATAL_FAILURE(run_job());
  const auto before = files_below(directory.path("out"));
  std::string broken = directory.read("data/training.csv");
  broken.replace(broken.find('\n', 2000) + 1, 4, "E,x,");
  directory.write("data/training.csv", broken);
  const auto result = run_frictab({"run", job});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(files_below(directory.path("out")), before);
}

TEST_F(SlowMainJob, ResultsOfAnEarlierRunDoNotLinger) {
  ASSERT_NO_FATAL_FAILURE(run_job());
  ASSERT_EQ(run_frictab({"run", job, "--set", "table.model=coulomb", "--set",
                         "models.use=[\"coulomb\", \"shear\"]"})
                .exit_code,
            0);
  EXPECT_FALSE(fs::exists(directory.path("out/tables/levanov.h5")));
  EXPECT_FALSE(fs::exists(directory.path("out/models/wzl.json")));
  EXPECT_TRUE(fs::exists(directory.path("out/export/c/recipe.json")));
}

TEST_F(SlowMainJob, DirectFormIsTheLawInEverySourceAndItsFilesKnowIt) {
  const std::vector<std::string> set = {"--set", "export.form=direct"};
  ASSERT_EQ(run_frictab({"run", job, set[0], set[1]}).exit_code, 0);
  for (const char* target : {"c", "abaqus_vfric"}) {
    const auto recipe = test::parse_json(
        directory.read(std::string("out/export/") + target + "/levanov/recipe.json"));
    EXPECT_EQ(recipe.at("form"), "direct");
  }
  EXPECT_EQ(run_frictab({"verify", job}).exit_code, 2) << "the job file says table";
  ASSERT_EQ(run_frictab({"verify", job, set[0], set[1]}).exit_code, 0);
  const auto verified = test::parse_json(directory.read("out/verify.json"));
  std::size_t direct = 0;
  for (const auto& record : verified.at("records"))
    if (std::string(record.at("subject")).ends_with("/double direct") ||
        record.at("subject") == "c/c99 direct") {
      ++direct;
      EXPECT_LT(record.at("worst_case_MPa"), 1e-9);
    }
  EXPECT_EQ(direct, 4U);
  ASSERT_EQ(run_frictab({"export", job}).exit_code, 0);
  EXPECT_NE(directory.read("out/export/c/levanov/recipe.json").find("\"form\": \"table\""),
            std::string::npos);
}

TEST_F(SlowMainJob, SummarySaysWhichFormIsFasterAndSmallerAndNoFileHoldsTimes) {
  const auto result = run_frictab({"run", job, "-v"});
  for (const char* part : {"Table or the law itself, as generated C", "law itself", "levanov"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  const bool verdict = result.out.find("export.form = \"direct\"") != std::string::npos ||
                       result.out.find("times faster than the law") != std::string::npos;
  EXPECT_TRUE(verdict) << result.out;
  const auto json = test::parse_json(run_frictab({"run", job, "--json"}).out);
  for (const auto& form : json.at("forms")) {
    EXPECT_GT(form.at("table").at("bytes"), 0);
    EXPECT_GT(form.at("direct").at("bytes"), 0);
    EXPECT_GT(form.at("table").at("ns_per_query"), 0);
    EXPECT_GT(form.at("direct").at("ns_per_query"), 0);
    EXPECT_LT(form.at("direct").at("drift_MPa"), 1e-9);
    EXPECT_LE(form.at("table").at("drift_MPa"), 0.5);
  }
  EXPECT_EQ(json.at("forms").size(), 2U);
  EXPECT_EQ(directory.read("out/verify.json").find("ns_per_query"), std::string::npos);
}

TEST_F(SlowMainJob, RowsOutsideTheRangeAreToldByAxisAndSide) {
  const auto run = [&](const std::string& outside) {
    return run_frictab({"run", job, "--set", "table.model=levanov", "--set",
                        "table.axes.sigma_n_MPa={range = [800, 1800], outside = " + outside + "}"});
  };
  const auto clamp = run("\"clamp\"");
  EXPECT_EQ(clamp.exit_code, 0) << clamp.out << clamp.err;
  EXPECT_NE(clamp.out.find("  levanov: sigma_n_MPa above 1800: "), std::string::npos) << clamp.out;
  EXPECT_NE(clamp.out.find(" beyond, clamp\n"), std::string::npos) << clamp.out;
  const auto law = run("[\"clamp\", \"law\"]");
  EXPECT_EQ(law.exit_code, 0) << law.out << law.err;
  EXPECT_NE(law.out.find(" beyond, law\n"), std::string::npos) << law.out;
  EXPECT_NE(directory.read("out/verify.json").find("\"side\": \"above\""), std::string::npos);
  EXPECT_NE(directory.read("out/report.html").find("sigma_n_MPa above 1800"), std::string::npos);
}

TEST_F(SlowMainJob, SourcesOfStatesThatSomeTargetsDoNotKnowAreToldForAllOfThemAtTheirPlace) {
  const auto result = run_frictab({"run", job, "--set",
                                   "export.targets=[\"abaqus_vfric\", \"marc_ufric\", "
                                   "\"qform_lua\"]",
                                   "--set", "export.inputs.sigma_f_MPa=field:1"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "--set 2: error: marc_ufric: 'field:1' is not a source of a state\n"
                        "  hint: known: constant:VALUE, solver; for this target alone: "
                        "[export.marc_ufric.inputs]\n"
                        "--set 2: error: qform_lua: 'field:1' is not a source of a state\n"
                        "  hint: known: constant:VALUE, property; for this target alone: "
                        "[export.qform_lua.inputs]\n"
                        "what was finished is kept in " +
                            directory.path("out/.frictab-kept") + "; `frictab run " + job +
                            " --set 'export.targets=[\"abaqus_vfric\", \"marc_ufric\", "
                            "\"qform_lua\"]' --set export.inputs.sigma_f_MPa=field:1` goes on from "
                            "there\n");
}

TEST_F(SlowMainJob, SectionOfOneTargetHoldsForItAlone) {
  directory.write("job.toml", std::string(job_text) + test::no_causes +
                                  "[export]\n"
                                  "targets = [\"abaqus_vfric\", \"marc_ufric\"]\n"
                                  "[export.inputs]\n"
                                  "sigma_f_MPa = \"constant:480\"\n"
                                  "[export.abaqus_vfric.inputs]\n"
                                  "sigma_f_MPa = \"curve:400 + 300*strain\"\n"
                                  "strain = \"field:1\"\n"
                                  "[export.qform_lua.inputs]\n"
                                  "sigma_f_MPa = \"property\"\n");
  const auto result = run_frictab({"run", job, "--set", "table.model=orowan"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.err, testing::HasSubstr("[export.qform_lua.inputs] is not used: qform_lua is "
                                             "not among export.targets"));
  const auto source = [&](const std::string& target, const std::string& quantity) {
    const auto recipe = test::parse_json(directory.read("out/export/" + target + "/recipe.json"));
    for (const auto& argument : recipe.at("arguments"))
      if (argument.at("quantity") == quantity) return argument.at("source").dump();
    return std::string();
  };
  EXPECT_THAT(source("abaqus_vfric", "strain"), testing::HasSubstr("field"));
  EXPECT_THAT(source("marc_ufric", "sigma_f_MPa"), testing::HasSubstr("480"));
  const auto refused =
      run_frictab({"export", job, "--set", "export.marc_ufric.inputs.sigma_f_MPa=\"field:1\"",
                   "--set", "table.model=orowan"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err, "--set 1: error: marc_ufric: 'field:1' is not a source of a state\n"
                         "  hint: known: constant:VALUE, solver\n");
}

TEST_F(SlowMainJob, StagesTakeTheTablesThatTableModelNames) {
  ASSERT_NO_FATAL_FAILURE(run_job());
  const auto verified = run_frictab({"verify", job, "--set", "table.model=levanov"});
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  const auto records = test::parse_json(directory.read("out/verify.json")).at("records");
  EXPECT_EQ(records.size(), 4U) << "table, C, VFRIC in two precisions";
  for (const auto& record : records)
    EXPECT_EQ(record.at("model"), "levanov");
  const auto none = run_frictab({"export", job, "--set", "table.model=shear"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, testing::HasSubstr("error: there is no table of shear\n  hint: there are "
                                           "tables of "));
  EXPECT_TRUE(fs::exists(directory.path("out/export/c/levanov/recipe.json"))) << "nothing is lost";
  const auto quantiles = run_frictab(
      {"run", job, "--set", "table.model=levanov", "--set", "table.quantile=[0.25, 0.5]"});
  ASSERT_EQ(quantiles.exit_code, 0) << quantiles.err;
  EXPECT_EQ(run_frictab({"export", job, "--set", "table.model=levanov", "--set",
                         "table.quantile=[0.25, 0.5]"})
                .exit_code,
            0);
  EXPECT_TRUE(fs::exists(directory.path("out/export/c/levanov_q25/recipe.json")));
  ASSERT_EQ(run_frictab({"run", job}).exit_code, 0);
  EXPECT_EQ(run_frictab({"export", job, "--set", "table.model=levanov"}).exit_code, 0);
  const auto others = run_frictab({"verify", job});
  EXPECT_EQ(others.exit_code, 2) << "the sources there are levanov's";
  EXPECT_THAT(others.err, testing::HasSubstr("there are no generated sources"));
  EXPECT_EQ(test::parse_json(directory.read("out/export/c/recipe.json")).at("model"), "levanov");
}

TEST_F(SlowMainJob, RoutinesAreComparedAtTheConstantsOfTheJobAndTheCostIsTold) {
  const auto result =
      run_frictab({"run", job, "-v", "--set", "table.model=levanov", "--set",
                   "export.targets=[\"abaqus_vfric\", \"abaqus_fric\", \"marc_ufric\"]", "--set",
                   "export.inputs.sigma_f_MPa=constant:480"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_NE(
      result.out.find("abaqus_vfric, abaqus_fric and marc_ufric fix sigma_f_MPa = 480: mean "),
      std::string::npos)
      << result.out;
  EXPECT_NE(result.err.find("marc_ufric is for 2-D models"), std::string::npos) << result.err;
  EXPECT_NE(
      result.out.find("Deviation from the law below the tested contact normal stresses, MPa:\n"
                      "    levanov: "),
      std::string::npos);
}

TEST_F(SlowMainJob, ARoutineInSinglePrecisionIsVerifiedAndItsRoundingReported) {
  const std::vector<std::string> set = {"--set", "table.model=levanov",
                                        "--set", "export.targets=[\"abaqus_vfric\"]",
                                        "--set", "export.inputs.sigma_f_MPa=constant:480"};
  std::vector<std::string> run = {"run", job, "-v"}, verify = {"verify", job};
  run.insert(run.end(), set.begin(), set.end());
  verify.insert(verify.end(), set.begin(), set.end());
  ASSERT_EQ(run_frictab(run).exit_code, 0);
  for (auto* command : {&run, &verify})
    command->insert(command->end(), {"--set", "export.options.outside_summary=at_exit"});
  const auto none = run_frictab(verify);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, testing::HasSubstr("is stale: [export] of the job has changed since"));
  const auto result = run_frictab(run);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out,
              testing::ContainsRegex(
                  "Routines in single precision, .*\n.*\n    levanov .* abaqus_vfric/single "));
  EXPECT_THAT(directory.read("out/verify.xml"), testing::HasSubstr("name=\"abaqus_vfric/single\""));
  const auto record = test::parse_json(directory.read("out/verify.json")).at("records").at(2);
  EXPECT_EQ(record.at("subject"), "abaqus_vfric/single");
  EXPECT_EQ(record.at("unit_roundoff"), 0x1p-24);
  EXPECT_GT(record.at("max_vs_table_MPa"), 0);
  fs::remove(directory.path("out/export/abaqus_vfric/frictab_vfric.f"));
  const auto gone = run_frictab(verify);
  EXPECT_EQ(gone.exit_code, 2);
  EXPECT_THAT(gone.err,
              testing::HasSubstr("out/export/abaqus_vfric/frictab_vfric.f: error: no such "
                                 "file\n"));
}

TEST_F(SlowMainJob, FilesOfTheUserInTheOutputDirectoryStay) {
  directory.write("out/models/mine.json", "{}");
  directory.write("out/export/c/driver.c", "int x;");
  ASSERT_EQ(run_frictab({"run", job}).exit_code, 0);
  ASSERT_EQ(run_frictab({"run", job, "--set", "export.targets=abaqus_vfric"}).exit_code, 0);
  EXPECT_EQ(directory.read("out/models/mine.json"), "{}");
  EXPECT_EQ(directory.read("out/export/c/driver.c"), "int x;");
  EXPECT_FALSE(fs::exists(directory.path("out/export/c/levanov/recipe.json")))
      << "of the first run";
}

TEST_F(MainJob, LeftoversOfAKilledRunAreCleanedUp) {
  directory.write("out/.frictab-99999999/models/x.json", "{}");
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  EXPECT_FALSE(fs::exists(directory.path("out/.frictab-99999999")));
}

TEST_F(MainJob, TypoInTheJobFileIsOneLineWithItsPlaceAndAHint) {
  const std::string file = directory.write("typo.toml", "[data]\ntraining = \"data/training.csv\"\n"
                                                        "[table]\ntolerence_MPa = 0.1\n");
  const auto result = run_frictab({"run", file});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, file + ":4:1: error: unknown key 'tolerence_MPa' in [table]\n"
                               "  hint: did you mean 'tolerance_MPa'?\n");
}

TEST_F(SlowMainJob, JsonSummaryIsJson) {
  const auto result = run_frictab({"run", job, "--json"});
  ASSERT_EQ(result.exit_code, 0);
  const auto j = test::parse_json(result.out);
  EXPECT_EQ(j.at("schema"), "frictab/summary/1");
  EXPECT_TRUE(j.at("synthetic_data"));
  EXPECT_EQ(j.at("verification").at("passed"), true);
}

TEST(CommandLine, UnknownCommandNamesTheNearest) {
  const auto result = run_frictab({"calibrat", "x"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.err, "error: unknown command 'calibrat'\n  hint: did you mean 'calibrate'?\n");
}

TEST(CommandLine, EveryHelpPageNamesTheExitCodes) {
  for (const char* command :
       {"run", "calibrate", "tabulate", "export", "verify", "report", "twin", "init", "list",
        "explain", "doctor", "table", "table info", "table slice", "table diff", "table convert"}) {
    std::istringstream words(command);
    std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    arguments.push_back("--help");
    const auto result = run_frictab(arguments);
    EXPECT_EQ(result.exit_code, 0) << command;
    EXPECT_EQ(result.err, "") << command;
    EXPECT_NE(result.out.find("Exit codes: 0 done; 1 a target was missed"), std::string::npos)
        << command;
  }
}

TEST_F(SlowMainJob, WithoutValidationFilesGoesThroughAllStagesAloneAsInOneRun) {
  const std::string file = directory.write(
      "few.toml", "[data]\ntraining = \"data/training.csv\"\n[export]\ntargets = [\"c\"]\n"
                  "[models]\nuse = [\"coulomb\", \"shear\", \"levanov\"]\n");
  const std::string whole = directory.path("whole"), parts = directory.path("parts");
  ASSERT_EQ(run_frictab({"run", file, "-j1", "-o", whole}).exit_code, 0);
  for (const char* stage : {"calibrate", "trace", "tabulate", "export", "verify", "report"}) {
    const auto result = run_frictab({stage, file, "-j2", "-o", parts});
    ASSERT_EQ(result.exit_code, 0) << stage << result.err;
  }
  const auto one = files_below(whole), two = files_below(parts);
  for (const char* name : {"calibration.json", "benchmark.md", "errors_by_experiment.csv"})
    EXPECT_TRUE(one.at(name) == two.at(name)) << name;
  EXPECT_NE(one.at("report.html").find("Each test is predicted by the law fitted to all others"),
            std::string::npos);
}

TEST_F(MainJob, VerboseSaysWhatWasDerivedFromTheData) {
  const std::string file =
      directory.write("derived.toml", "[data]\ntraining = \"data/training.csv\"\nholdout = 0.25\n");
  const auto result = run_frictab({"calibrate", file, "-v"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "4 of 16 experiments held out to validate, drawn by seed 1\n");
}

TEST(SlowExample, SyntheticCampaignReproducesThePublishedLevelsOfError) {
  const TemporaryDirectory directory;
  ASSERT_EQ(run_frictab({"twin", directory.path("data"), "--oracle"}).exit_code, 0);
  fs::copy(fs::path(FRICTAB_SOURCE_DIR) / "examples" / "01_synthetic_campaign" / "job.toml",
           directory.path("job.toml"));
  const auto result = run_frictab({"run", directory.path("job.toml")});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  std::map<std::string, double> mae;
  const auto calibration = test::parse_json(directory.read("out/calibration.json"));
  for (const auto& model : calibration.at("models"))
    mae[model.at("name")] = model.at("validation").at("mae_MPa");
  EXPECT_EQ(mae.size(), 17U);
  EXPECT_NEAR(mae.at("coulomb_0.04"), 51, 2.5);
  EXPECT_NEAR(mae.at("coulomb_0.08"), 24, 2.5);
  EXPECT_NEAR(mae.at("shear_0.12"), 95, 2.5);
  for (const char* law :
       {"coulomb", "shear", "orowan", "coulomb_mean", "shear_mean", "orowan_mean"}) {
    EXPECT_GT(mae.at(law), 12) << law;
    EXPECT_LT(mae.at(law), 15) << law;
  }
}

// Measured data, as the rigs wrote them. Found beside the sources or where FRICTAB_MEASURED says.
fs::path measured_files(const std::string& folder) {
  const char* set = std::getenv("FRICTAB_MEASURED");
  const fs::path measured =
      set ? fs::path(set) : fs::path(FRICTAB_SOURCE_DIR) / ".." / "shared" / "measured";
  return measured / folder / "data";
}

struct MeasuredExample {
  const char* job;
  const char* folder;
  std::size_t laws; // that need no flow stress; a neural network only with five experiments
};
void PrintTo(const MeasuredExample& example, std::ostream* out) {
  *out << example.job;
}
class LongMeasured : public testing::TestWithParam<MeasuredExample> {};

TEST_P(LongMeasured, ExampleRunsEndToEnd) {
  const auto [example, folder, laws] = GetParam();
  const fs::path measured = measured_files(folder);
  if (!fs::is_directory(measured))
    GTEST_SKIP() << "the measured files are not here; set FRICTAB_MEASURED to their directory";
  const TemporaryDirectory directory;
  fs::copy(fs::path(FRICTAB_SOURCE_DIR) / "examples" / example / "job.toml",
           directory.path("job.toml"));
  fs::create_directory_symlink(fs::canonical(measured), directory.path("data"));
  const auto result = run_frictab({"run", directory.path("job.toml")});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out.find("SYNTHETIC"), std::string::npos);
  const auto calibration = test::parse_json(directory.read("out/calibration.json"));
  EXPECT_EQ(calibration.at("models").size(), laws);
  const auto best = calibration.at("models").at(0).at("validation");
  for (const auto& model : calibration.at("models")) {
    if (model.at("name") != "coulomb_0.04") continue;
    EXPECT_LT(best.at("mae_MPa").get<double>(),
              0.5 * model.at("validation").at("mae_MPa").get<double>())
        << "calibration on measured data beats a constant of another field";
  }
  EXPECT_TRUE(fs::exists(directory.path("out/export/abaqus_vfric/coulomb/recipe.json")));
  const auto scatter =
      test::parse_json(directory.read("out/trace.json")).at("scatter_between_experiments");
  EXPECT_LT(scatter.at("interval_95").at(1).get<double>(), 32 * scatter.at("share").get<double>())
      << "one degree of freedom, the least there is: 1 over the root of 0.00098";
}

INSTANTIATE_TEST_SUITE_P(
    Examples, LongMeasured,
    testing::Values(MeasuredExample{"02_rock_velocity_steps", "rock_velocity_steps", 7},
                    MeasuredExample{"03_ptfe_pin_on_disc", "pps_ptfe_pin_on_disc", 9}));

// The origin's own comparison of test means: 18.6 % in the logarithm, p = 0.003 by t-test.
TEST(MeasuredExample, FillerOfTheCompositesIsFoundAndPredictsTestsThatWereLeftOut) {
  const fs::path measured = measured_files("al10cu_composites");
  if (!fs::is_directory(measured))
    GTEST_SKIP() << "the measured files are not here; set FRICTAB_MEASURED to their directory";
  const TemporaryDirectory directory;
  fs::copy(fs::path(FRICTAB_SOURCE_DIR) / "examples" / "08_composite_filler", directory.path());
  fs::create_directory_symlink(fs::canonical(measured), directory.path("data"));
  const auto result = run_command({test::program(), "run", directory.path("job.toml")});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  const auto trace = test::parse_json(directory.read("out/trace.json"));
  EXPECT_EQ(trace.at("verdict"), "effect_added");
  EXPECT_EQ(trace.at("unseen"), "nested_cross_validation");
  ASSERT_EQ(trace.at("effects").size(), 1u);
  const auto& effect = trace.at("effects").at(0);
  EXPECT_EQ(effect.at("columns").at(0), "material");
  EXPECT_EQ(effect.at("acts_on"), "mu") << "one load: nothing tells the places apart";
  EXPECT_NEAR(effect.at("parameters").at(0).at("value"), std::expm1(0.186), 0.03);
  EXPECT_GT(trace.at("improvement").at("validation_mae_MPa"), 0);
  EXPECT_TRUE(fs::exists(directory.path("out/export/c/recipe.json")));
}

} // namespace
} // namespace frictab::pipeline_test
