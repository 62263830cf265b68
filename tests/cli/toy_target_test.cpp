// Adding a target touches nothing else: frictab_toy is the program with one more file.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"

namespace frictab::toy_target_test {
namespace {

using test::CommandResult;
using test::run_command;
using testing::HasSubstr;

CommandResult toy(std::vector<std::string> arguments, const std::string& directory = "") {
  const auto build = std::filesystem::path(test::program()).parent_path();
  arguments.insert(arguments.begin(), build / "tests" / "frictab_toy");
  return run_command(arguments, directory);
}

TEST(ToyTarget, IsListedExplainedAndAllowedInJobsBecauseItIsLinked) {
  EXPECT_THAT(toy({"list", "targets"}).out, HasSubstr("toy "));
  EXPECT_THAT(toy({"explain", "toy"}).out, HasSubstr("verified: by its own test"));
  EXPECT_THAT(test::run_frictab({"list", "targets"}).out, testing::Not(HasSubstr("toy ")));
  EXPECT_EQ(test::run_frictab({"explain", "toy"}).exit_code, 2);
}

TEST(SlowToyTarget, IsGeneratedDrivenAndVerifiedByTheMainJob) {
  const test::TemporaryDirectory directory;
  ASSERT_EQ(toy({"twin", "data", "-q", "--design",
                 "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=6"},
                directory.path())
                .exit_code,
            0);
  directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                              "validation = \"data/validation.csv\"\n"
                              "[models]\nuse = [\"coulomb\", \"orowan\"]\n"
                              "[table]\nmodel = \"all\"\n[export]\ntargets = \"toy\"\n");
  const CommandResult run = toy({"run", "job.toml", "-q"}, directory.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const auto verification = test::parse_json(directory.read("out/verify.json"));
  std::size_t driven = 0;
  for (const auto& record : verification.at("records"))
    if (record.at("subject") == "toy/text") {
      ++driven;
      EXPECT_LE(double(record.at("worst_case_MPa")), 1e-9);
    }
  EXPECT_EQ(driven, 3u) << "two laws, and the better one with the effects that it lacks";
}

} // namespace
} // namespace frictab::toy_target_test
