// A campaign's key changes with what its result depends on, and with nothing else.
#include <filesystem>
#include <set>

#include "core/error.h"
#include "core/shard.h"
#include "study/keys.h"
#include "study/plan.h"
#include "study/small_study.h"

namespace frictab::study_keys_test {
namespace {

namespace fs = std::filesystem;
using study::Plan;

class StudyKeys : public test::SmallStudy {
protected:
  void SetUp() override {
    SmallStudy::SetUp();
    write_three();
  }
  std::vector<std::uint64_t> keys(const std::string& folder = "",
                                  const study::StudyOverrides& overrides = {}) const {
    const std::string file = directory.path(folder) + "/study.toml";
    return study::plan_of(study::read_study(file, overrides)).keys;
  }
};

TEST_F(StudyKeys, AreAsManyAsCampaignsAndAreReadBack) {
  const auto all = keys();
  EXPECT_EQ(std::set(all.begin(), all.end()).size(), 3u);
  for (const std::uint64_t key : all)
    EXPECT_EQ(study::read_key(study::key_text(key)), key);
  EXPECT_EQ(study::read_key("0123456789abcde"), std::nullopt) << "15 digits";
  EXPECT_EQ(study::read_key("0123456789abcdeg"), std::nullopt);
}

TEST_F(StudyKeys, ChangeByOneByteOfData) {
  const auto before = keys();
  change_a_digit("b/validation.csv");
  const auto after = keys();
  EXPECT_EQ(after[0], before[0]);
  EXPECT_NE(after[1], before[1]);
  EXPECT_EQ(after[2], before[2]);
}

TEST_F(StudyKeys, StayWhereTheStudyMoves) {
  const auto before = keys();
  fs::create_directory(directory.path("elsewhere"));
  for (const char* name : {"a", "b", "c", "job.toml", "study.toml"})
    fs::rename(directory.path(name), directory.path(std::string("elsewhere/") + name));
  EXPECT_EQ(keys("elsewhere"), before);
}

TEST_F(StudyKeys, StayWhereTheJobWritesElsewhereOrIsLaidOutAnew) {
  const auto before = keys();
  directory.write("job.toml", "# a remark\n[calibration]\nbootstrap = 100\n[output]\ndirectory = "
                              "\"x\"\n[models]\nuse = [\"coulomb\",   \"shear\"]\n");
  EXPECT_EQ(keys(), before);
}

TEST_F(StudyKeys, ChangeWithJobStageAndOverrides) {
  const auto before = keys();
  study::StudyOverrides trace, seed;
  trace.stage = study::LastStage::trace;
  seed.set = {"calibration.seed=7"};
  const auto traced = keys("", trace), seeded = keys("", seed);
  directory.write("job.toml", std::string(test::small_job) + "seed = 2\n");
  const auto changed = keys();
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_NE(traced[i], before[i]);
    EXPECT_NE(seeded[i], before[i]);
    EXPECT_NE(changed[i], before[i]);
    EXPECT_NE(changed[i], seeded[i]);
  }
}

TEST_F(StudyKeys, ChangeWithATableThatAllCampaignsShare) {
  directory.write("job.toml", std::string(test::small_job) + "[data]\ntests = \"tests.csv\"\n");
  directory.write("tests.csv", "experiment,batch\na,1\n");
  const auto before = keys();
  directory.write("tests.csv", "experiment,batch\na,2\n");
  const auto after = keys();
  for (std::size_t i = 0; i < before.size(); ++i)
    EXPECT_NE(after[i], before[i]);
}

TEST_F(StudyKeys, OfATwinDependOnSeedAndBlock) {
  const std::string one = test::twin_study(2), other = test::twin_study(2, "noise_scale = 2\n");
  const auto keys_of = [&](const std::string& text) {
    return study::plan_of(study::parse_study(text, directory.path("study.toml"))).keys;
  };
  const auto a = keys_of(one), b = keys_of(other);
  EXPECT_EQ(std::set({a[0], a[1], b[0], b[1]}).size(), 4u);
  EXPECT_EQ(keys_of(one), a);
}

TEST_F(StudyKeys, OfCampaignsThatAreTheSameAreTold) {
  directory.write("study.toml", directory.read("study.toml") +
                                    "[[campaign]]\nname = \"d\"\nfiles = \"a/training.csv\"\n"
                                    "validation = \"a/validation.csv\"\n");
  const Plan plan = study::plan_of(study::read_study(directory.path("study.toml")));
  EXPECT_EQ(plan.keys[3], plan.keys[0]);
  EXPECT_EQ(plan.notes, std::vector<std::string>{"campaigns 'a' and 'd' have the same job and the "
                                                 "same data: one result is for both"});
}

TEST(StudyShards, PartTheKeys) {
  for (std::uint64_t key = 1000; key < 1100; ++key) {
    int shards = 0;
    for (const char* text : {"1/7", "2/7", "3/7", "4/7", "5/7", "6/7", "7/7"})
      shards += read_shard(text).has(key);
    EXPECT_EQ(shards, 1) << key;
  }
  EXPECT_TRUE(read_shard("1/1").has(12));
}

TEST(StudyShards, AreRefusedWhereTheyAreNone) {
  for (const char* text : {"", "1", "/", "0/2", "3/2", "1/0", "-1/2", "1/2/3", "a/b", "1/ 2"})
    EXPECT_THROW(read_shard(text), InputError) << text;
}

} // namespace
} // namespace frictab::study_keys_test
