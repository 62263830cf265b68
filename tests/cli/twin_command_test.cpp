// Claims about `frictab twin`, run in this process through the command registry.
#include <filesystem>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"
#include "core/error.h"
#include "io/file_streams.h"
#include "support/json.h"

namespace frictab::twin_command_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

class TwinCommand : public testing::Test {
protected:
  void SetUp() override {
    directory_ = fs::path(testing::TempDir()) /
                 ("frictab_twin_" +
                  std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(directory_);
  }
  void TearDown() override { fs::remove_all(directory_); }

  // Standard output of the command.
  std::string run(std::vector<std::string> arguments, bool force = false,
                  std::uint64_t seed = 1) const {
    cli::CommonOptions common;
    common.force = force;
    common.seed = seed;
    CLI::App app;
    const cli::Command* command = Registry<cli::Command>::instance().find("twin");
    const auto body = command->declare(app, common);
    arguments.push_back(directory_.string());
    std::reverse(arguments.begin(), arguments.end());
    app.parse(arguments);
    testing::internal::CaptureStdout();
    try {
      EXPECT_EQ(body(), 0);
    } catch (...) {
      testing::internal::GetCapturedStdout();
      throw;
    }
    return testing::internal::GetCapturedStdout();
  }

  std::string content(const char* name) const { return io::read_file(directory_ / name); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path directory_;
  const std::vector<std::string> small_ = {"--design", "v=50;T=20;points=20;validation=3"};
};

TEST_F(TwinCommand, WritesCampaignJobAndSettings) {
  const std::string out = run(small_);
  EXPECT_THAT(out, HasSubstr("synthetic (frictab twin, set D, seed 1)"));
  EXPECT_EQ(files(),
            (std::vector<std::string>{"job.toml", "training.csv", "twin.json", "validation.csv"}));
  EXPECT_THAT(content("training.csv"),
              StartsWith("experiment,time_s,sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,T_tool_C,s_mm,"
                         "sigma_f_MPa,tau_R_MPa,run_order,humidity_pct,film_um,Ra_um,tool,origin\n"
                         "E001,0,500,1,50,20,20,0,"));
  EXPECT_THAT(content("job.toml"), HasSubstr("validation = \"validation.csv\""));
  EXPECT_THAT(content("job.toml"), HasSubstr("\n[table]\nrange = \"table1\""));
  const auto json = test::parse_json(content("twin.json"));
  EXPECT_EQ(json["synthetic"], true);
  EXPECT_EQ(json["schema"], "frictab/twin/1");
  EXPECT_GT(json["training"]["errors"]["oracle"]["mae_MPa"], 0.0);
  EXPECT_EQ(json["validation"]["n_experiments"], 3);
}

TEST_F(TwinCommand, EveryFileSaysSynthetic) {
  auto arguments = small_;
  arguments.push_back("--oracle");
  run(arguments);
  EXPECT_EQ(files().size(), 6u);
  for (const std::string& name : files())
    EXPECT_THAT(content(name.c_str()), HasSubstr("synthetic")) << name;
  EXPECT_THAT(content("training_oracle.csv"),
              StartsWith("experiment,row,tau_oracle_MPa,origin\nE001,1,"));
}

TEST_F(TwinCommand, RecordsPlantedEffects) {
  auto arguments = small_;
  arguments.insert(arguments.end(),
                   {"--effect", "form=saturation,column=s_mm,strength=0.5", "--effect",
                    "form=linear,column=friction_work,amplitude=0.1,on=tau"});
  EXPECT_THAT(run(arguments), HasSubstr("saturation of s_mm on mu"));
  const auto effects = test::parse_json(content("twin.json"))["effects"];
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0]["columns"], nlohmann::ordered_json({"s_mm"}));
  EXPECT_NEAR(effects[0]["strength"].get<double>(), 0.5, 1e-6);
  EXPECT_EQ(effects[0]["parameters"][1]["unit"], "mm");
  EXPECT_EQ(effects[1]["derived"], "friction_work");
  EXPECT_EQ(effects[1]["acts_on"], "tau");
}

TEST_F(TwinCommand, RepeatsItselfButOverwritesNothingElse) {
  run(small_);
  const std::string first = content("training.csv");
  run(small_);
  EXPECT_EQ(content("training.csv"), first);
  EXPECT_THROW(run(small_, false, 2), InputError);
  EXPECT_EQ(content("training.csv"), first);
  run(small_, true, 2);
  EXPECT_NE(content("training.csv"), first);
}

TEST_F(TwinCommand, LeavesNothingBehindAfterAFault) {
  auto arguments = small_;
  arguments.insert(arguments.end(), {"--effect", "form=nonsense,column=s_mm,strength=1"});
  EXPECT_THROW(run(arguments), InputError);
  EXPECT_FALSE(fs::exists(directory_));
}

TEST_F(TwinCommand, WritesHdf5AndNoBystanders) {
  auto arguments = small_;
  arguments.insert(arguments.end(), {"--format", "hdf5", "--no-bystanders"});
  run(arguments);
  EXPECT_EQ(files(),
            (std::vector<std::string>{"job.toml", "training.h5", "twin.json", "validation.h5"}));
  EXPECT_THAT(content("job.toml"), HasSubstr("training.h5"));
}

TEST_F(TwinCommand, RecordsLawProfileAndScatter) {
  auto arguments = small_;
  EXPECT_THAT(run(arguments), testing::Not(HasSubstr("truth ")));
  for (const char* key : {"law", "profile", "more_bystanders"})
    EXPECT_FALSE(test::parse_json(content("twin.json")).contains(key)) << key;
  arguments.insert(arguments.end(), {"--law", "orowan", "--profile", "varied", "--scatter",
                                     "test=0.04,rho=0.9", "--more-bystanders", "--effect",
                                     "form=category,column=direction,strength=0.1,on=m"});
  EXPECT_THAT(run(arguments, true), HasSubstr("truth       orowan: mu 0."));
  const auto json = test::parse_json(content("twin.json"));
  EXPECT_EQ(json["law"]["name"], "orowan");
  EXPECT_GT(json["law"]["parameters"]["m"], 0.1);
  EXPECT_EQ(json["constants"]["base_law"].size(), 2u);
  EXPECT_EQ(json["profile"], "varied");
  EXPECT_EQ(json["noise"]["test"], 0.04);
  EXPECT_EQ(json["noise"]["ar_rho"], 0.9);
  EXPECT_EQ(json["more_bystanders"], true);
  EXPECT_THAT(content("training.csv"),
              HasSubstr(",tool,film2_um,lab_T_C,dwell_s,direction,batch,vib,origin\n"));
}

} // namespace
} // namespace frictab::twin_command_test
