// --dry-run tells what the command then does, and writes nothing.
#include <filesystem>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file_streams.h"
#include "support/small_campaign.h"

namespace frictab::dry_run_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using testing::HasSubstr;

class DryRun : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write("[calibration]\nseed = 1\n");
  }
  void write(const std::string& more) const {
    write_job("[models]\nuse = [\"coulomb\", \"shear\"]\n[table]\nmodel = \"coulomb\"\n"
              "[export]\ntargets = [\"c\", \"fortran\"]\n" +
              more);
  }
  std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(directory.path()))
      if (entry.is_regular_file())
        all[fs::relative(entry.path(), directory.path()).string()] = io::read_file(entry.path());
    return all;
  }
  nlohmann::json plan(const std::string& command, int exit_code = 0) const {
    const auto before = files();
    const CommandResult result = frictab({command, "--dry-run", "--json"});
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    EXPECT_TRUE(files() == before) << command << " has written";
    return nlohmann::json::parse(result.out);
  }
  static std::map<std::string, std::string> actions(const nlohmann::json& plan) {
    std::map<std::string, std::string> out;
    for (const auto& stage : plan.at("stages"))
      out[stage.at("stage")] = stage.at("action");
    return out;
  }
};

using Actions = std::map<std::string, std::string>;

TEST_F(DryRun, NamesTheFilesThatTheRunThenWrites) {
  const nlohmann::json told = plan("run");
  EXPECT_FALSE(fs::exists(directory.path("out")));
  ASSERT_EQ(frictab({"run", "-q"}).exit_code, 0);
  std::set<std::string> named{"stages.json"};
  for (const auto& stage : told.at("stages"))
    for (const std::string name : stage.at("writes"))
      if (name.find("where an effect") == name.npos) named.insert(name);
  for (const std::string& name : named)
    EXPECT_TRUE(fs::exists(directory.path("out/" + name))) << name;
  for (const auto& [file, text] : files()) {
    if (!file.starts_with("out/") || file == "out/.frictab.lock") continue;
    if (file.ends_with("_traced.json")) continue; // where an effect is added
    const std::string name = file.substr(4);
    const std::string folder = name.substr(0, name.find('/', 7) + 1); // export/TARGET/
    EXPECT_TRUE(named.count(name) + named.count(folder) > 0) << name << " was not named";
  }
}

TEST_F(DryRun, SaysWhichStagesRunWhichAreKeptAndWhichAreStale) {
  EXPECT_EQ(actions(plan("export")),
            (Actions{{"calibrate", "run"}, {"tabulate", "run"}, {"export", "run"}}));
  EXPECT_EQ(actions(plan("verify", 2)), (Actions{{"calibrate", "refuse"},
                                                 {"tabulate", "refuse"},
                                                 {"export", "refuse"},
                                                 {"verify", "run"}}))
      << "a gate makes nothing";
  ASSERT_EQ(frictab({"export", "-q"}).exit_code, 0);
  EXPECT_EQ(
      actions(plan("verify")),
      (Actions{
          {"calibrate", "keep"}, {"tabulate", "keep"}, {"export", "keep"}, {"verify", "run"}}));
  write("[calibration]\nseed = 2\n");
  EXPECT_EQ(actions(plan("tabulate", 2)), (Actions{{"calibrate", "refuse"}, {"tabulate", "run"}}));
  EXPECT_EQ(frictab({"tabulate", "-q"}).exit_code, 2) << "as was told";
  EXPECT_EQ(actions(plan("run")).at("calibrate"), "run");
  EXPECT_THAT(frictab({"tabulate", "--dry-run"}).out,
              HasSubstr("[models] or [calibration] of the job has changed since"));
}

TEST_F(DryRun, ChecksTheJobAndTheDataAsTheRunDoes) {
  directory.write("data/training.csv", "experiment,sigma_n_MPa,tau_R_MPa\na,-1,2\n");
  const CommandResult told = frictab({"run", "--dry-run"}), ran = frictab({"run"});
  EXPECT_EQ(told.exit_code, 2);
  EXPECT_EQ(told.err, ran.err);
}

} // namespace
} // namespace frictab::dry_run_test
