// "frictab trace" and the loop of "run": an undeclared effect goes in, a routine with it comes out.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_command.h"

namespace frictab::trace_command_test {
namespace {

using test::run_frictab;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string usual_design = "p=500,1200,2750;psi=1,4.47,20;v=5,500;T=20,110,200;points=25";
const std::vector<std::string> campaign = {"--law",     "log_coulomb",
                                           "--profile", "varied",
                                           "--scatter", "test=0.04,slow=0.03,rho=0.8,white=0.015"};

class TraceCommand : public testing::Test {
protected:
  void make(std::vector<std::string> effects, const std::string& more = "",
            const std::string& design = usual_design) {
    std::vector<std::string> call = {"twin", directory.path("data"), "-q", "--design", design};
    call.insert(call.end(), campaign.begin(), campaign.end());
    for (const std::string& effect : effects) {
      call.push_back("--effect");
      call.push_back(effect);
    }
    ASSERT_EQ(run_frictab(call).exit_code, 0);
    directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                                "validation = \"data/validation.csv\"\n"
                                "[models]\nuse = [\"coulomb\", \"log_coulomb\"]\n"
                                "[calibration]\nbootstrap = 100\n" +
                                    more);
    job = directory.path("job.toml");
  }
  Json trace() { return Json::parse(directory.read("out/trace.json")); }

  test::TemporaryDirectory directory;
  std::string job;
};

const std::string humidity = "form=power,column=humidity_pct,strength=0.5";
const std::string run_in = "form=saturation,column=s_mm,strength=0.3,x0=3";

using LongTraceCommand = TraceCommand;

TEST_F(LongTraceCommand, RunShipsTheEffectThatNobodyDeclared) {
  make({humidity, run_in}, "[export]\ntargets = [\"c\", \"abaqus_vfric\"]\n"
                           "[export.inputs]\nhumidity_pct = \"field:1\"\n");
  const auto result = run_frictab({"run", job});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("What log_coulomb lacks, by its residual: effect added"));
  EXPECT_THAT(result.out, HasSubstr("SYNTHETIC data"));
  const Json t = trace();
  EXPECT_EQ(t.at("schema"), "frictab/trace/1");
  EXPECT_EQ(t.at("verdict"), "effect_added");
  EXPECT_EQ(t.at("synthetic_data"), true);
  std::set<std::string> causes;
  for (const Json& effect : t.at("effects"))
    causes.insert(effect.at("columns").at(0).get<std::string>());
  EXPECT_THAT(causes, testing::IsSupersetOf({"humidity_pct", "s_mm"}));
  const double before = t.at("before").at("validation").at("mae_MPa");
  const double after = t.at("after").at("validation").at("mae_MPa");
  EXPECT_LT(after, 0.85 * before);
  // The law with the effects is the best one, so it is what was tabulated, exported and verified.
  EXPECT_TRUE(std::filesystem::exists(directory.path("out/tables/log_coulomb_traced.h5")));
  EXPECT_TRUE(std::filesystem::exists(directory.path("out/models/log_coulomb_traced.json")));
  const Json recipe = Json::parse(directory.read("out/export/c/recipe.json"));
  EXPECT_THAT(recipe.dump(), HasSubstr("in_humidity_pct"));
  const Json drift = Json::parse(directory.read("out/verify.json"));
  ASSERT_FALSE(drift.at("records").empty());
  for (const Json& record : drift.at("records"))
    EXPECT_LE(double(record.at("worst_case_MPa")), 0.5) << record.at("subject");
  const std::string report = directory.read("out/report.html");
  EXPECT_THAT(report, HasSubstr("What the law lacks"));
  EXPECT_THAT(report, HasSubstr("residual before, unseen experiments"));
  EXPECT_THAT(report, HasSubstr("residual after, unseen experiments"));
}

TEST_F(TraceCommand, SaysThatNothingWasFoundAndWhatItCouldHaveSeen) {
  make({});
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  const auto result = run_frictab({"trace", job, "--power"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("log_coulomb lacks, by its residual: no missing effect found"));
  EXPECT_THAT(result.out, HasSubstr("Smallest effect on mu that this campaign would have shown"));
  EXPECT_THAT(result.out, HasSubstr("humidity_pct"));
  EXPECT_THAT(result.out, HasSubstr("would have been seen (80 %) from"));
  EXPECT_EQ(trace().at("verdict"), "nothing_found");
  EXPECT_TRUE(trace().at("effects").empty());
  EXPECT_FALSE(std::filesystem::exists(directory.path("out/models/log_coulomb_traced.json")));
  // Nothing is missing only beside what the rig is known to repeat.
  const auto known = run_frictab({"trace", job, "--set", "trace.repeatability=0.05"});
  ASSERT_EQ(known.exit_code, 0) << known.err;
  EXPECT_THAT(known.out,
              HasSubstr("no effect is missing: the remaining scatter is within the rig"));
  EXPECT_EQ(trace().at("verdict"), "nothing_missing");
}

TEST_F(LongTraceCommand, ForgetsTheLawOfAnEarlierTrace) {
  make({humidity});
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  ASSERT_EQ(run_frictab({"trace", job}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(directory.path("out/models/log_coulomb_traced.json")));
  const auto without = run_frictab({"trace", job, "--set", "trace.ignore=\"humidity_pct\""});
  ASSERT_EQ(without.exit_code, 0) << without.err;
  EXPECT_EQ(directory.read("out/calibration.json").find("humidity_pct"), std::string::npos);
}

TEST_F(LongTraceCommand, TracesEveryLawAskedFor) {
  // (Coulomb's law lacks much here: few tests, so that a search is quick.)
  make({humidity}, "", "p=500,2750;psi=1,20;v=5,500;T=20,200;points=20");
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  ASSERT_EQ(run_frictab({"trace", job, "--set", "trace.models=\"all\""}).exit_code, 0);
  const Json t = trace();
  EXPECT_EQ(t.at("model"), "log_coulomb");
  ASSERT_EQ(t.at("others").size(), 1u);
  EXPECT_EQ(t.at("others").at(0).at("model"), "coulomb");
}

TEST_F(LongTraceCommand, ReportShowsAHistoryOfTheLawsOwnStress) {
  make({"form=saturation,column=friction_work,strength=0.5"});
  const auto result = run_frictab({"run", job});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("+ friction_work"));
  EXPECT_THAT(directory.read("out/report.html"), HasSubstr("friction_work"));
}

TEST_F(LongTraceCommand, ALawThatIsExactLacksNothing) {
  ASSERT_EQ(run_frictab({"twin", directory.path("data"), "-q", "--law", "coulomb", "--noise-scale",
                         "0", "--design", "points=40;p=500,2000;psi=1,20;v=5;T=20,200"})
                .exit_code,
            0);
  job = directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                                    "validation = \"data/validation.csv\"\n"
                                    "[models]\nuse = \"coulomb\"\n");
  const auto result = run_frictab({"run", job});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("coulomb lacks, by its residual: nothing"));
}

// In one fold of the nested search an effect is found on the limit, which effects found after it
// leave without influence.
TEST_F(LongTraceCommand, GoesOnWhereALaterEffectTakesTheSiteOfAnEarlierOne) {
  ASSERT_EQ(run_frictab({"twin", directory.path("data"), "-q", "--seed", "16", "--design",
                         "p=1725,2005;psi=1,4.47,20;v=5,500;T=20,200;points=20;validation=6",
                         "--effect", "form=power,column=humidity_pct,strength=0.5,on=mu"})
                .exit_code,
            0);
  directory.write("job.toml", "[data]\ntraining = \"data/training.csv\"\n"
                              "validation = \"data/validation.csv\"\n"
                              "[models]\nuse = [\"coulomb\", \"shear\", \"log_coulomb\"]\n"
                              "[calibration]\nbootstrap = 200\n");
  const auto result = run_frictab({"trace", directory.path("job.toml")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(TraceCommand, NamesAColumnThatIsNotThere) {
  make({});
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  const auto result = run_frictab({"trace", job, "--set", "trace.ignore=[\"humidity_pt\"]"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--set 1: error: the data have no column 'humidity_pt'"));
  EXPECT_THAT(result.err, HasSubstr("did you mean 'humidity_pct'?"));
}

TEST_F(TraceCommand, SaysWhereTheJobNamesAColumnThatIsNotThere) {
  make({});
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  directory.write("job.toml",
                  directory.read("job.toml") + "[trace]\ntool_distance = \"run_ordr\"\n");
  const auto result = run_frictab({"trace", job});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("job.toml:9:17: error: the data have no column 'run_ordr'\n"
                                    "  hint: did you mean 'run_order'?"));
}

TEST_F(TraceCommand, SaysWhereTheJobNamesAnOrderThatIsNotThere) {
  make({}, "[trace]\norder = \"run_ordr\"\n");
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  const auto result = run_frictab({"trace", job});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("job.toml:9:9: error: the data have no column 'run_ordr'\n"
                                    "  hint: did you mean 'run_order'?"));
}

TEST_F(TraceCommand, TakesNoOrderFromAColumnThatOrdersNothing) {
  make({});
  ASSERT_EQ(run_frictab({"calibrate", job}).exit_code, 0);
  const auto fault = [&](const std::string& set) {
    const auto result = run_frictab({"trace", job, "--set", "trace." + set});
    EXPECT_EQ(result.exit_code, 2) << set;
    return result.err;
  };
  EXPECT_THAT(fault("order=time_s"),
              HasSubstr("time_s, the order of tests: every test begins with the same value\n"
                        "  hint: a number that counts the tests, or when each was made"));
  EXPECT_THAT(fault("order=v_rel_mm_s"), HasSubstr("the tests begin with two values only"));
  EXPECT_THAT(fault("order=tool"), HasSubstr("'A' is neither a number nor a time stamp"));
  EXPECT_THAT(fault("order=tau_R_MPa"), HasSubstr("it is what was measured"));
  EXPECT_THAT(fault("tool_distance=tool"), HasSubstr("'tool' is not a distance: it holds text"));
  EXPECT_THAT(fault("tool_distance=tau_R_MPa"), HasSubstr("it is what was measured"));
}

TEST_F(TraceCommand, CalibratesFirstInAnEmptyDirectory) {
  make({});
  const auto result = run_frictab({"trace", job});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("there was no calibration: the laws were calibrated first\n"));
}

} // namespace
} // namespace frictab::trace_command_test
