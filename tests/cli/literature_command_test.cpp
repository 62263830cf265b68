// Laws of the literature through the whole tool, and what the commands say of them.
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "job/literature.h"
#include "support/small_campaign.h"

namespace frictab::literature_command_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using testing::HasSubstr;
using testing::StartsWith;

class LongLiterature : public test::SmallCampaign {
protected:
  void export_to(const std::string& targets) {
    std::string names;
    for (const auto& law : job::literature().own())
      names += (names.empty() ? "\"" : ", \"") + law->name + "\"";
    write_job("[data.constants]\nviscosity_Pa_s = 0.1\nsigma_eq_MPa = 250\n"
              "[models]\nuse = [" +
              names + "]\n[table]\nmodel = \"all\"\n[export]\ntargets = " + targets + "\n");
    const CommandResult result = frictab({"export", "job.toml"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
};

TEST_F(LongLiterature, GoesTheWholeWayToEveryTarget) {
  export_to("\"all\"");
  export_to("[\"c\", \"abaqus_vfric\"]"); // two that are compiled and run, for the time it takes
  const CommandResult verified = frictab({"verify", "job.toml"});
  ASSERT_EQ(verified.exit_code, 0) << verified.err;
  const auto file = nlohmann::json::parse(directory.read("out/verify.json"));
  EXPECT_TRUE(file.at("passed").get<bool>());
  for (const auto& law : job::literature().own())
    EXPECT_THAT(verified.out, HasSubstr(law->name));
}

TEST_F(LongLiterature, ALawWithAStateIsTracedAndFittedToAllTests) {
  write_job("[models]\nuse = [\"coulomb\", \"rate_and_state_aging\"]\n"
            "[calibration]\ndeliver = \"all\"\n[trace]\nmodels = [\"rate_and_state_aging\"]\n"
            "[table]\nmodel = \"rate_and_state_aging\"\n[export]\ntargets = [\"c\"]\n");
  const CommandResult result = frictab({"run", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("What rate_and_state_aging lacks"));
  EXPECT_THAT(directory.read("out/models/rate_and_state_aging.json"),
              HasSubstr("aging_state_over_"));
}

TEST(LiteratureCommands, ListSaysThatTheyAreThereByName) {
  const CommandResult list = run_frictab({"list", "models"});
  EXPECT_THAT(list.out, HasSubstr("\n\nwhere models.use names them, as [\"all\", "
                                  "\"filzek_ludwig\"]:\nfilzek_ludwig "));
  const auto json = nlohmann::json::parse(run_frictab({"list", "models", "--json"}).out);
  for (const auto& law : json)
    EXPECT_EQ(law.contains("by_name"), job::literature_text(law.at("name")) != "");
}

TEST(LiteratureCommands, ExplainGivesATextToCopy) {
  const CommandResult text = run_frictab({"explain", "norton", "--toml"});
  EXPECT_THAT(text.out, StartsWith("[models.norton]\ntitle = "));
  EXPECT_THAT(text.out, HasSubstr("[models.norton.parameters]\nalpha = { range = "));
  const CommandResult none = run_frictab({"explain", "coulomb", "--toml"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err, "--toml: error: 'coulomb' is not a law of the literature\n"
                      "  hint: `frictab list models` names them\n");
}

TEST(LiteratureCommands, ExportOfALawAloneTakesThem) {
  const test::TemporaryDirectory directory;
  const CommandResult result = run_frictab(
      {"export", "--law", "wang_oil", "--param", "mu1=0.12", "--param", "mu2=0.06", "--range",
       "sigma_f_MPa=300..900", "--targets", "c", "-o", directory.path("out")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

// Columns of the laboratory's and histories have no range of the paper's: it is asked for.
TEST(SlowLiteratureAlone, IsExportedWithTheRangesThatTheMessageAsksFor) {
  const test::TemporaryDirectory directory;
  for (const auto& law : job::literature().own()) {
    SCOPED_TRACE(law->name);
    std::vector<std::string> arguments = {
        "export", "--law", law->name, "--targets", "c", "-o", directory.path(law->name)};
    for (const models::Parameter& p : law->parameters)
      arguments.insert(arguments.end(), {"--param", fmt::format("{}={}", p.name, p.start)});
    CommandResult result = run_frictab(arguments);
    const std::regex range("--range (\\w+)=LOW");
    for (std::sregex_iterator found(result.err.begin(), result.err.end(), range), end; found != end;
         ++found)
      arguments.insert(arguments.end(), {"--range", (*found)[1].str() + "=1..2"});
    if (result.exit_code == 2) result = run_frictab(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  }
}

} // namespace
} // namespace frictab::literature_command_test
