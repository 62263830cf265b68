// study.toml and lists of campaigns: what is taken, and every fault at once.
#include <gmock/gmock.h>

#include "core/error.h"
#include "io/file_streams.h"
#include "study/plan.h"
#include "study/small_study.h"
#include "study/study.h"

namespace frictab::study_read_test {
namespace {

using testing::HasSubstr;

class StudyFile : public test::SmallStudy {
protected:
  study::Study parse(const std::string& text, const study::StudyOverrides& overrides = {}) const {
    return study::parse_study(text, directory.path("study.toml"), overrides);
  }
  // With the folder left out of the places.
  std::string faults(const std::string& text) const {
    try {
      study::plan_of(parse(text));
    } catch (const InputError& error) {
      std::string what = error.what();
      for (const std::string folder = directory.path() + "/";;) {
        const std::size_t at = what.find(folder);
        if (at == std::string::npos) return what;
        what.erase(at, folder.size());
      }
    }
    return "";
  }
};

TEST_F(StudyFile, IsToldAllItsFaultsAtOnce) {
  EXPECT_EQ(faults("job = \"job.toml\"\n"
                   "stage = \"tracee\"\n"
                   "[[twin]]\n"
                   "seed = \"9..1\"\n"
                   "effect = \"form=powr,column=x,strength=0.1\"\n"
                   "noise = \"loud\"\n"
                   "[[campaign]]\n"
                   "name = \"a\"\n"
                   "fils = \"a.csv\"\n"
                   "[[campaign]]\n"
                   "name = \"a\"\n"
                   "files = \"a.csv\"\n"
                   "set = [\"tabel.x=1\", \"data.training=b\"]\n"
                   "factors = { law = \"x\", oil = true }\n"),
            "study.toml:2:9: error: there is no stage 'tracee'\n"
            "  hint: known: calibrate, trace, run\n"
            "study.toml:4:8: error: twin.seed must be a seed or a range of them, not the text "
            "\"9..1\"\n"
            "  hint: write seed = 7, or seed = \"1..1000\"\n"
            "study.toml:5:10: error: --effect: unknown form 'powr'\n"
            "  hint: did you mean 'power'?\n"
            "study.toml:3:1: error: --noise: unknown noise 'loud'\n"
            "  hint: known: normal, t4, heteroscedastic\n"
            "study.toml:9:1: error: unknown key 'fils' in [[campaign]]\n"
            "  hint: did you mean 'files'?\n"
            "study.toml:14:30: error: factor oil must be a text or a number, not true\n"
            "study.toml:7:1: error: campaign 'a' has no files\n"
            "  hint: write files = \"data/*.csv\", relative to the study\n"
            "study.toml:10:1: error: --set 2: a study does not take data.training\n"
            "  hint: files stand in campaigns, the directory in study.toml\n"
            "study.toml:10:1: error: --set 1: unknown key 'tabel' at the top of the file\n"
            "  hint: did you mean 'table'?\n"
            "study.toml:10:1: error: a factor cannot be called 'law'\n"
            "  hint: campaigns.csv has a column of that name\n"
            "study.toml:10:1: error: there are two campaigns called 'a'\n"
            "  hint: reports distinguish them by name\n"
            "study.toml:10:1: error: campaign 'a': a.csv: cannot be read\n"
            "  hint: files of a campaign are named relative to the study");
}

TEST_F(StudyFile, IsRefusedWithoutJobOrCampaigns) {
  EXPECT_THAT(faults("[[twin]]\nseed = 1\n"), HasSubstr("there is no job"));
  EXPECT_THAT(faults("job = \"job.toml\"\n"), HasSubstr("there is no campaign"));
  EXPECT_THAT(faults("job = \"no.toml\"\n[[twin]]\nseed = 1\n"), HasSubstr("no.toml"));
  EXPECT_THAT(faults("job = \"job.toml\"\n[[twin]]\nseed = \"1..9999999\"\n"),
              HasSubstr("asks for 9,999,999 campaigns; a study has at most 1,000,000"));
  EXPECT_THAT(faults(std::string(2u << 20, '#')), HasSubstr("campaigns = \"list.csv\""));
}

TEST_F(StudyFile, NamesFilesThatAreNotThereByCampaign) {
  const std::string what = faults("job = \"job.toml\"\n[[campaign]]\nname = \"x\"\n"
                                  "files = \"no/*.csv\"\n[[campaign]]\nname = \"y\"\nfiles = "
                                  "\"no.csv\"\n");
  EXPECT_THAT(what, HasSubstr("study.toml:2:1: error: campaign 'x': "));
  EXPECT_THAT(what, HasSubstr("study.toml:5:1: error: campaign 'y': no.csv: cannot be read"));
}

TEST_F(StudyFile, OfATableHasACampaignPerRowAndEveryOtherColumnAsFactor) {
  directory.write("list.csv", "name,files,set,lubricant,batch\n"
                              "one,a.csv;b.csv,calibration.seed=3,oil,007\n"
                              "two,c.csv,,,8\n");
  const study::Study study = parse("job = \"job.toml\"\ncampaigns = \"list.csv\"\n");
  ASSERT_EQ(study.campaigns.size(), 2u);
  EXPECT_EQ(study.factors, (std::vector<std::string>{"lubricant", "batch"}));
  const study::Campaign &one = study.campaigns[0], &two = study.campaigns[1];
  EXPECT_EQ(one.training, (std::vector<std::string>{"a.csv", "b.csv"}));
  EXPECT_EQ(one.factors, (std::vector<std::string>{"oil", "007"}));
  EXPECT_EQ(two.factors, (std::vector<std::string>{"", "8"}));
  EXPECT_EQ(study.jobs[one.job].job.calibration.seed, 3u);
  EXPECT_EQ(study.jobs[two.job].job.calibration.seed, 1u);
}

TEST_F(StudyFile, OfATableIsRefusedWithoutNamesOrFiles) {
  directory.write("list.csv", "title,files\none,a.csv\n");
  EXPECT_THAT(faults("job = \"job.toml\"\ncampaigns = \"list.csv\"\n"),
              HasSubstr("list.csv:1: error: there is no column name"));
}

TEST_F(StudyFile, MayLieInAnotherFolderThanItsJob) {
  directory.write("jobs/base.toml", test::small_job);
  const study::Study study = parse("job = \"jobs/base.toml\"\n[[campaign]]\nname = \"a\"\nfiles = "
                                   "\"data/a.csv\"\n");
  EXPECT_EQ(study.campaigns[0].training, std::vector<std::string>{"../data/a.csv"});
}

TEST_F(StudyFile, OfTheDocumentationAndOfTheExampleAreRead) {
  const std::string page = io::read_file(FRICTAB_SOURCE_DIR "/docs/study.md");
  const std::size_t begin = page.find("```toml\n") + 8;
  directory.write("list.csv", "name,files\none,a.csv\n");
  const study::Study shown = parse(page.substr(begin, page.find("```", begin) - begin));
  EXPECT_EQ(shown.campaigns.size(), 1002u);
  EXPECT_EQ(shown.factors.size(), 4u);
  const study::Study example =
      study::read_study(FRICTAB_SOURCE_DIR "/examples/11_study/study.toml");
  EXPECT_EQ(example.campaigns.size(), 30u);
}

TEST_F(StudyFile, GivesEachTwinASeedAndItsFactors) {
  const study::Study study = parse("job = \"job.toml\"\n[[twin]]\nname = \"dry\"\nseed = \"4..6\"\n"
                                   "factors = { oil = \"none\" }\n[[twin]]\nseed = 1\n");
  ASSERT_EQ(study.campaigns.size(), 4u);
  EXPECT_EQ(study.campaigns[2].name, "dry-6");
  EXPECT_EQ(study.campaigns[2].twin->seed, 6u);
  EXPECT_EQ(study.campaigns[2].factors, std::vector<std::string>{"none"});
  EXPECT_EQ(study.campaigns[3].name, "twin-1");
  EXPECT_EQ(study.campaigns[3].factors, std::vector<std::string>{""});
}

} // namespace
} // namespace frictab::study_read_test
