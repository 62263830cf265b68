// The commands that explain: init, list, explain, doctor.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/explanation.h"
#include "codegen/exporter.h"
#include "effects/effect.h"
#include "job/literature.h"
#include "job/schema.h"
#include "support/json.h"
#include "support/run_command.h"

namespace frictab::discovery_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::StartsWith;

TEST(InitCommand, WritesAJobThatIsReadAndSaysWhatToDoNext) {
  const TemporaryDirectory directory;
  const CommandResult result = run_frictab({"init", "new"}, directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "new/job.toml\n");
  EXPECT_THAT(result.err, HasSubstr("frictab run new/job.toml"));
  EXPECT_EQ(directory.read("new/job.toml"), job::job_template());
  EXPECT_NO_THROW(job::read_job(directory.path("new/job.toml")));
}

TEST(InitCommand, ReplacesAFileOnlyByForce) {
  const TemporaryDirectory directory;
  directory.write("job.toml", "mine");
  const CommandResult refused = run_frictab({"init", "."}, directory.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err, "./job.toml: error: is there already\n"
                         "  hint: name another directory, or --force to replace it\n");
  EXPECT_EQ(directory.read("job.toml"), "mine");
  EXPECT_EQ(run_frictab({"init", ".", "--force"}, directory.path()).exit_code, 0);
  EXPECT_EQ(directory.read("job.toml"), job::job_template());
}

TEST(InitCommand, RefusesAFileInPlaceOfADirectory) {
  const TemporaryDirectory directory;
  directory.write("there", "mine");
  const CommandResult result = run_frictab({"init", "there"}, directory.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, StartsWith("there: error: is a file, a directory is needed"));
}

TEST(InitCommand, IsSilentOnStandardErrorUnderQuiet) {
  const TemporaryDirectory directory;
  EXPECT_EQ(run_frictab({"init", "new", "-q"}, directory.path()).err, "");
}

TEST(ListCommand, NamesEveryLawEffectAndTarget) {
  const auto names = [](const char* what) {
    const CommandResult result = run_frictab({"list", what, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    std::vector<std::string> out;
    for (const auto& item : test::parse_json(result.out)) {
      EXPECT_FALSE(item.at("title").get<std::string>().empty());
      out.push_back(item.at("name"));
    }
    return out;
  };
  const std::vector<std::string> laws = job::literature().names();
  std::vector<std::string> effects, targets;
  for (const effects::EffectForm& effect : effects::all_effects())
    effects.push_back(effect.name);
  for (const codegen::Exporter& target : codegen::all_exporters())
    targets.push_back(target.name);
  EXPECT_EQ(names("models"), laws);
  EXPECT_EQ(names("effects"), effects);
  EXPECT_EQ(names("targets"), targets);
}

TEST(ListCommand, AlignsNamesAndTitles) {
  const CommandResult result = run_frictab({"list", "models"});
  const auto column_of = [&](const std::string& name, const std::string& title) {
    const std::size_t line = result.out.find("\n" + name + " ") + 1;
    return result.out.find(title, line) - line;
  };
  const std::size_t column = column_of("coulomb", "Coulomb friction\n");
  EXPECT_GT(column, std::string("rate_and_state_aging").size());
  EXPECT_EQ(column_of("log_coulomb", "extended Coulomb, logarithmic\n"), column);
  EXPECT_EQ(column_of("norton", "Norton: viscoplastic shear law\n"), column);
}

TEST(ListCommand, NamesTheListsForAnUnknownOne) {
  const CommandResult result = run_frictab({"list", "model"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "error: there is no list of 'model'\n  hint: did you mean 'models'?\n");
}

TEST(ExplainCommand, ShowsALaw) {
  const CommandResult result = run_frictab({"explain", "shaw"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, StartsWith("shaw (friction law)\n"));
  for (const char* part : {"tau_R = m k u/(1+u^n)^(1/n), u = mu sigma_N/(m k)",
                           "inputs:      sigma_n_MPa, sigma_f_MPa", "sharpness of the transition",
                           "0.5 .. 20", "reference:"})
    EXPECT_THAT(result.out, HasSubstr(part));
}

TEST(ExplainCommand, ShowsAJobKeyWithItsDefault) {
  EXPECT_EQ(run_frictab({"explain", "table.tolerance_MPa"}).out,
            "table.tolerance_MPa (job key)\n"
            "  largest drift of the table from its law, anywhere in the range; the grid is\n"
            "  made to fit it. auto: 0.5 or a twentieth of the law's mean absolute error on\n"
            "  unseen tests, the smaller\n"
            "  value:    \"auto\" or a number > 0\n"
            "  default:  \"auto\"\n");
  EXPECT_THAT(run_frictab({"explain", "table.axes.psi.nodes"}).out,
              StartsWith("table.axes.*.nodes (job key)"));
}

TEST(ExplainCommand, ShowsEveryKeyOfTheJob) {
  const CommandResult result = run_frictab({"explain", "job"});
  for (const job::KeyRule& rule : job::key_rules())
    EXPECT_THAT(result.out, HasSubstr("\n    " + rule.path + "\n"));
}

TEST(ExplainCommand, ShowsAQuantityAsJson) {
  const auto json = test::parse_json(run_frictab({"explain", "psi", "--json"}).out);
  EXPECT_EQ(json.at("kind"), "quantity");
  EXPECT_EQ(json.at("unit"), "1");
  EXPECT_EQ(json.at("range of the paper"), "1 .. 20");
}

TEST(ExplainCommand, KnowsEveryNameThatIsListed) {
  for (const std::string& name : cli::explainable()) {
    const auto explanation = cli::explain(name);
    ASSERT_TRUE(explanation) << name;
    EXPECT_FALSE(explanation->title.empty()) << name;
  }
}

TEST(ExplainCommand, NamesTheNearestForAnUnknownName) {
  const CommandResult result = run_frictab({"explain", "shwa"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "error: nothing is called 'shwa'\n  hint: did you mean 'shaw'?\n");
}

TEST(DoctorCommand, SaysWhatThisMachineHas) {
  const CommandResult result = run_frictab({"doctor", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  std::map<std::string, nlohmann::ordered_json> found;
  for (const auto& item : test::parse_json(result.out))
    found[item.at("name")] = item;
  for (const char* library : {"HDF5", "NLopt", "Eigen"})
    EXPECT_TRUE(found.at(library).at("ok")) << library;
  EXPECT_THAT(found.at("gcc").at("text").get<std::string>(), HasSubstr("/gcc"));
  for (const codegen::Exporter& target : codegen::all_exporters())
    EXPECT_TRUE(found.at(target.name).at("ok")) << found.at(target.name);
}

TEST(DoctorCommand, ListsEveryLibraryThatIsLoadedInJsonAndTheirNumberInText) {
  std::size_t loaded = 0;
  for (const auto& item : test::parse_json(run_frictab({"doctor", "--json"}).out)) {
    EXPECT_EQ(item.size(), 6u) << "keys that scripts know";
    const std::string name = item.at("name"), text = item.at("text");
    if (item.at("topic") != "library" || name.find(".so") == name.npos) continue;
    ++loaded;
    EXPECT_TRUE(std::filesystem::exists(text)) << name << ": " << text;
    EXPECT_FALSE(std::filesystem::is_symlink(text)) << name << ": " << text;
    if (name.starts_with("libz.so")) {
      EXPECT_THAT(text, testing::ContainsRegex("/libz\\.so\\.1\\.[0-9.]+$"));
    }
  }
  EXPECT_GT(loaded, 15u);
  const std::string text = run_frictab({"doctor"}).out;
  EXPECT_THAT(text, HasSubstr(std::to_string(loaded) + " shared ones are loaded (--json lists"));
  for (const char* library : {"HDF5 1.", "NLopt 2.", "Eigen 3.", "oneTBB 2021.", "PCRE2 10."})
    EXPECT_THAT(text, HasSubstr(library));
  EXPECT_THAT(text, testing::Not(HasSubstr(".so")));
}

TEST(DoctorCommand, FailsAndSaysHowToMendWhereCompilersAreMissing) {
  const TemporaryDirectory empty;
  const CommandResult result = run_frictab({"doctor"}, "", {"PATH=" + empty.path()});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.out, HasSubstr("MISSING  gcc"));
  EXPECT_THAT(result.out, HasSubstr("mend: apt install gfortran"));
  EXPECT_THAT(result.out, HasSubstr("absent   clang"));
  EXPECT_THAT(result.out, HasSubstr("verify cannot run it: needs "));
  EXPECT_THAT(result.err,
              HasSubstr("missing: gcc (apt install gcc), gfortran (apt install gfortran)"));
}

} // namespace
} // namespace frictab::discovery_test
