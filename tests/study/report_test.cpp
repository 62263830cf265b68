// The report counts what the results say.
#include "study/report_study.h"

#include <filesystem>

#include <gmock/gmock.h>

#include "core/error.h"
#include "core/hash.h"
#include "core/no_value.h"
#include "io/csv.h"
#include "io/json.h"
#include "study/keys.h"
#include "study/result_store.h"
#include "study/small_study.h"

namespace frictab::study_report_test {
namespace {

namespace fs = std::filesystem;
using study::CampaignResult;
using testing::HasSubstr;
using testing::Not;

CampaignResult made_up(double mu, bool coulomb_first) {
  CampaignResult result;
  result.data_hash = "0";
  result.judged_by = "validation_files";
  result.synthetic = true;
  result.experiments = 12;
  result.rows = 120;
  study::LawResult coulomb{"coulomb",  true, 1,   2,   0,
                           {0.5, 1.5}, 1,    0.9, 1.1, {{"mu", "1", mu, 0.001}}};
  study::LawResult shear{"shear",    true, 3,  4,  -1,
                         {2.5, 3.5}, 0.01, {}, {}, {{"m", "1", 0.1, no_value}}};
  if (!coulomb_first) std::swap(coulomb.best_p_value, shear.best_p_value);
  result.laws = {coulomb, shear};
  if (!coulomb_first) std::swap(result.laws[0], result.laws[1]);
  result.traced = true;
  return result;
}

class StudyReport : public test::SmallStudy {
protected:
  study::Plan plan(int campaigns) const {
    const std::string text = test::twin_study(campaigns, "factors = { oil = \"a\" }\n");
    return study::plan_of(study::parse_study(text, directory.path("study.toml")));
  }
  void write(const study::Plan& plan, std::size_t i, const CampaignResult& result) const {
    const std::string key = study::key_text(plan.keys[i]), folder = "study/results/" + key;
    const std::string stages = io::sealed("{\n  \"files\": {}\n}\n");
    directory.write(folder + "/stages.json", stages);
    CampaignResult whole = result;
    whole.stages_hash = hash_text(hash_of(stages));
    directory.write(folder + "/study.json", study::result_json(whole, key));
  }
};

TEST_F(StudyReport, ResultsAreReadBackAsTheyWere) {
  CampaignResult result = made_up(0.1, true);
  result.effects = {{"coulomb", "humidity_pct", "power", "mu", 0.001, 1.5}};
  result.missed = {"drift"};
  const std::string text = study::result_json(result, "0000000000000001");
  EXPECT_EQ(study::result_json(study::parse_result(text, "study.json"), "0000000000000001"), text);
  EXPECT_THROW(study::parse_result(text.substr(0, 100), "study.json"), InputError);
  EXPECT_THROW(study::parse_result("{\"schema\": \"frictab/study-result/2\"}", "study.json"),
               InputError);
}

TEST_F(StudyReport, CountsHowOftenEachLawIsBestOrNotToldFromTheBest) {
  const study::Plan all = plan(5);
  for (std::size_t i = 0; i < 3; ++i)
    write(all, i, made_up(0.1 + 0.001 * static_cast<double>(i), i < 2));
  study::write_failure(all.study.directory, all.keys[3], {"twin-4", "no <rows>", true});
  const study::Tally tally = study::report_study(all);
  EXPECT_EQ(tally.counts.done, 3u);
  EXPECT_EQ(tally.counts.failed, 1u);
  EXPECT_EQ(tally.counts.missing, 1u);
  EXPECT_EQ(tally.laws.at("coulomb").best, 2u);
  EXPECT_EQ(tally.laws.at("coulomb").may_be_best, 2u);
  EXPECT_EQ(tally.laws.at("shear").best, 1u);
  EXPECT_EQ(tally.laws.at("shear").may_be_best, 1u);
  EXPECT_EQ(tally.laws.at("coulomb").parameters[0].estimates.size(), 3u);
  EXPECT_EQ(tally.laws.at("shear").parameters[0].without_error, 3u);
  const std::string page = directory.read("study/report.html");
  EXPECT_THAT(page, HasSubstr("<strong>Synthetic data.</strong> 3 of 3 campaigns"));
  EXPECT_THAT(page, HasSubstr("no &lt;rows&gt;"));
  EXPECT_THAT(page, HasSubstr("mu of coulomb"));
}

TEST_F(StudyReport, WritesARowPerCampaignAndLaw) {
  const study::Plan all = plan(4);
  write(all, 0, made_up(0.1, true));
  write(all, 2, made_up(0.2, false));
  study::write_failure(all.study.directory, all.keys[3], {"twin-4", "no rows", true});
  study::report_study(all);
  FaultList faults;
  const io::CsvTable table =
      io::parse_csv(directory.read("study/campaigns.csv"), "campaigns.csv", {}, faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(table.rows(), 6u) << "two laws twice, one missing, one failed";
  EXPECT_THAT(directory.read("study/campaigns.csv"),
              HasSubstr(",a,12,120,validation_files,coulomb,1,1,0.5,1.5,2,0,1,true,0.9,1.1,"
                        "mu=0.1,mu=0.001,,\n"));
}

TEST_F(StudyReport, CountsCampaignsThatAreTheSameOnce) {
  study::Plan all = plan(3);
  all.keys[1] = all.keys[0];
  for (const std::size_t i : {0, 2})
    write(all, i, made_up(0.1, true));
  const study::Tally tally = study::report_study(all);
  EXPECT_EQ(tally.laws.at("coulomb").campaigns, 2u);
}

TEST_F(StudyReport, CountsAResultThatIsDamagedAndSaysWhatMendsIt) {
  const study::Plan all = plan(3);
  write(all, 0, made_up(0.1, true));
  const std::string folder = "study/results/" + study::key_text(all.keys[1]);
  directory.write(folder + "/study.json", "{");
  directory.write("study/failed/" + study::key_text(all.keys[2]) + ".json", "");
  const study::Tally tally = study::report_study(all);
  EXPECT_EQ(tally.counts.done, 1u);
  EXPECT_EQ(tally.counts.damaged, 2u);
  const std::string text = study::report_text(all, tally);
  EXPECT_THAT(text,
              HasSubstr("failed: twin-2: its result is damaged: study.json: its hash does not "
                        "fit; `frictab study run` makes it again\n"));
  EXPECT_THAT(text, HasSubstr("failed: twin-3: its result is damaged: "));
  EXPECT_EQ(tally.laws.at("coulomb").campaigns, 1u);
}

TEST_F(StudyReport, AdviceRepeatsWhatTheCommandLineSaid) {
  const std::string text = test::twin_study(1, "");
  const study::StudyOverrides said = {
      "else where", study::LastStage::calibrate, {"calibration.loss=\"L1\""}};
  const study::Plan plan =
      study::plan_of(study::parse_study(text, directory.path("study.toml"), said));
  EXPECT_THAT(study::status_text(plan, study::Found("nowhere")),
              HasSubstr("/study.toml -o 'else where' --stage calibrate --set "
                        "'calibration.loss=\"L1\"'\n"));
}

TEST_F(StudyReport, WithoutResultsSaysSo) {
  const study::Plan all = plan(2);
  EXPECT_THROW(study::report_study(all), InputError) << "the wrong directory?";
  study::write_failure(all.study.directory, all.keys[1], {"twin-2", "no rows", true});
  study::report_study(all);
  const std::string page = directory.read("study/report.html");
  EXPECT_THAT(page, HasSubstr("No campaign has a result yet."));
  EXPECT_THAT(page, Not(HasSubstr("nan")));
}

} // namespace
} // namespace frictab::study_report_test
