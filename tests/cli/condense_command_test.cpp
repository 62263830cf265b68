// data.condense as a user meets it: the same laws and errors from blocks as from rows, said so.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace frictab::condense_command_test {
namespace {

using nlohmann::json;
using test::CommandResult;
using testing::HasSubstr;

// SYNTHETIC: 16 tests of 3,520 rows to train, 8 to validate.
class LongCondense : public testing::Test {
protected:
  static void SetUpTestSuite() {
    directory = new test::TemporaryDirectory;
    ASSERT_EQ(run({"twin", "data", "--seed", "3", "--design",
                   "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=3520;validation=8"})
                  .exit_code,
              0);
    for (const auto& [name, condense] : {std::pair("rows", "0"), {"blocks", "880"}})
      directory->write(std::string(name) + ".toml",
                       "[data]\ntraining = \"data/training.csv\"\nvalidation = "
                       "\"data/validation.csv\"\ncondense = " +
                           std::string(condense) + "\n[table]\nmodel = \"exp_coulomb\"\n" +
                           "[output]\ndirectory = \"" + name + "\"\n");
    for (const char* name : {"rows", "blocks"}) {
      const CommandResult result = run({"calibrate", std::string(name) + ".toml", "--json"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      directory->write(std::string(name) + ".json", result.out);
    }
  }
  static void TearDownTestSuite() { delete directory; }

  static CommandResult run(const std::vector<std::string>& arguments) {
    return test::run_frictab(arguments, directory->path());
  }
  static json summary(const std::string& of) { return json::parse(directory->read(of + ".json")); }
  static json laws() { // fitted to rows
    return json::parse(directory->read("rows/calibration.json"))["models"];
  }
  // The same law fitted to blocks.
  static json from_blocks(const json& law) {
    const json all = json::parse(directory->read("blocks/calibration.json"));
    for (const json& other : all["models"])
      if (other["name"] == law["name"]) return other;
    return {};
  }

  static inline test::TemporaryDirectory* directory = nullptr;
};

TEST_F(LongCondense, FindsTheParametersOfTheRows) {
  int compared = 0;
  const json all = laws();
  for (const json& law : all) {
    const json parameters = law["parameters"], others = from_blocks(law)["parameters"];
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      if (!parameters[p]["std_error"].is_number() || parameters[p]["std_error"] == 0) continue;
      const double error = parameters[p]["std_error"], a = parameters[p]["value"],
                   b = others[p]["value"];
      EXPECT_LT(std::abs(a - b), 0.1 * error) << law["name"] << " " << parameters[p]["name"];
      ++compared;
    }
    if (!law.contains("polynomial")) continue;
    const json terms = law["polynomial"]["terms"];
    const json others_terms = from_blocks(law)["polynomial"]["terms"];
    for (const json& term : terms)
      for (const json& other : others_terms)
        if (other["term"] == term["term"]) {
          const double error = term["std_error"], a = term["coefficient"], b = other["coefficient"];
          EXPECT_LT(std::abs(a - b), std::max(0.1 * error, 1e-4)) // of ln mu
              << term["term"];
          ++compared;
        }
  }
  EXPECT_GT(compared, 60);
}

TEST_F(LongCondense, TakesErrorsFromTheRows) {
  const json all = laws();
  ASSERT_GT(all.size(), 12u);
  for (const json& law : all) {
    const json other = from_blocks(law);
    for (const char* part : {"training", "validation"}) {
      EXPECT_EQ(law[part]["n_rows"], other[part]["n_rows"]);
      for (const char* error : {"mae_MPa", "rmse_MPa"}) {
        const double a = law[part][error], b = other[part][error];
        EXPECT_NEAR(a, b, 1e-3 * a) << law["name"] << " " << part << " " << error;
      }
    }
  }
}

TEST_F(LongCondense, SaysWhatIsOfBlocks) {
  const json condensed = summary("blocks")["condensed"];
  EXPECT_EQ(condensed["rows"], 24 * 3520);
  EXPECT_GE(condensed["blocks"], 24 * 880);
  EXPECT_LT(condensed["blocks"], 24 * 900); // with the short ones of a test's start
  EXPECT_FALSE(summary("rows").contains("condensed"));
  EXPECT_THAT(run({"data", "blocks.toml"}).out,
              HasSubstr("means over blocks of rows (data.condense)"));
}

TEST_F(LongCondense, GivesTheSameBytesWithAnyNumberOfThreads) {
  const std::string before = directory->read("blocks/calibration.json");
  for (const char* threads : {"-j1", "-j4"}) {
    ASSERT_EQ(run({"calibrate", "blocks.toml", "-o", "again", "--force", threads}).exit_code, 0);
    EXPECT_EQ(directory->read("again/calibration.json"), before) << threads;
    EXPECT_EQ(directory->read("again/errors_by_experiment.csv"),
              directory->read("blocks/errors_by_experiment.csv"));
  }
}

TEST_F(LongCondense, TablesReachWhatTheRowsReach) {
  const auto axes = [](const std::string& of) {
    const CommandResult result = run({"tabulate", of + ".toml", "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out)["tables"][0]["axes"];
  };
  const json of_rows = axes("rows"), of_blocks = axes("blocks");
  for (std::size_t a = 0; a < of_rows.size(); ++a)
    EXPECT_EQ(of_rows[a]["data"], of_blocks[a]["data"]) << of_rows[a]["name"];
}

TEST_F(LongCondense, TracesBlocks) {
  const CommandResult result = run({"trace", "blocks.toml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("means over blocks of rows (data.condense)"));
}

} // namespace
} // namespace frictab::condense_command_test
