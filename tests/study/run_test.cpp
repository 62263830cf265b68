// Studies as users run them: what is missing is computed, what is there stays.
#include <filesystem>
#include <functional>

#include <gmock/gmock.h>

#include "study/small_study.h"
#include "support/json.h"

namespace frictab::study_run_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using testing::HasSubstr;

class StudyRun : public test::SmallStudy {
protected:
  std::size_t results() const {
    std::error_code none;
    const fs::directory_iterator all(directory.path("study/results"), none);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }
};
using SlowStudyRun = StudyRun;

TEST_F(StudyRun, ComputesWhatIsMissingAndAChangedCampaignAgain) {
  write_three();
  EXPECT_EQ(frictab({"study", "run"}).out, "3 computed, 0 were there, 0 failed\n");
  EXPECT_EQ(frictab({"study", "run"}).out, "0 computed, 3 were there, 0 failed\n");
  change_a_digit("b/training.csv");
  EXPECT_EQ(frictab({"study", "run"}).out, "1 computed, 2 were there, 0 failed\n");
  EXPECT_EQ(results(), 4u) << "the former result stays";
  const CommandResult report = frictab({"study", "report", "--json"});
  EXPECT_EQ(test::parse_json(report.out)["done"], 3);
}

TEST_F(StudyRun, KeepsFailuresAndGoesOn) {
  write_three();
  directory.write("b/training.csv", "experiment,tau_R_MPa\na,1\n");
  const CommandResult run = frictab({"study", "run"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "2 computed, 0 were there, 1 failed\n");
  EXPECT_THAT(run.err, HasSubstr("error: 1 campaign failed\n  hint: `frictab study status"));
  EXPECT_THAT(frictab({"study", "status"}).out, HasSubstr("failed: b: b/training.csv"));
  EXPECT_EQ(frictab({"study", "run", "--failures-ok"}).exit_code, 0);
  EXPECT_EQ(frictab({"study", "run", "--retry"}).out, "0 computed, 2 were there, 1 failed\n");
  EXPECT_EQ(frictab({"study", "report"}).exit_code, 0);
  EXPECT_THAT(directory.read("study/campaigns.csv"), HasSubstr("failed"));
}

TEST_F(StudyRun, OfShardsWritesTheSameBytesAsOneProcess) {
  directory.write("study.toml", test::twin_study(12));
  ASSERT_EQ(frictab({"study", "run", "-j1", "-o", "whole"}).exit_code, 0);
  for (const char* shard : {"2/3", "1/3", "3/3"})
    EXPECT_EQ(frictab({"study", "run", "--shard", shard}).out,
              "4 computed, 0 were there, 0 failed\n");
  EXPECT_EQ(difference("whole/results", "study/results"), "");
}

TEST_F(StudyRun, LeavesNoDataOfTheTwinAndNoWorkingDirectory) {
  directory.write("study.toml", test::twin_study(2));
  ASSERT_EQ(frictab({"study", "run"}).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(directory.path("study"))) {
    EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
    EXPECT_NE(entry.path().filename(), "training.csv") << entry.path();
  }
}

TEST_F(StudyRun, FindsADamagedResultAndMakesItAgain) {
  write_three();
  ASSERT_EQ(frictab({"study", "run"}).exit_code, 0);
  EXPECT_EQ(frictab({"study", "check"}).out, "3 results checked, all as they were written\n");
  fs::copy(directory.path("study"), directory.path("right"), fs::copy_options::recursive);
  const auto plan = test::parse_json(frictab({"study", "plan", "--json"}).out);
  const auto folder = [&](int i) {
    return "study/results/" + std::string(plan["keys"][i]["key"]) + "/";
  };
  const std::string first = folder(0);
  const std::vector<std::function<void()>> damages = {
      [&] { fs::remove(directory.path(first + "study.json")); },
      [&] { directory.write(first + "study.json", ""); },
      [&] { change_a_digit(first + "study.json"); },
      [&] { directory.write(first + "study.json", directory.read(folder(1) + "study.json")); },
      [&] { directory.write(first + "stages.json", directory.read(folder(1) + "stages.json")); },
      [&] { change_a_digit(first + "calibration.json"); },
      [&] { fs::remove(directory.path(first + "models/coulomb.json")); },
      [&] { directory.write(first + "benchmark.md", "a page of somebody else"); }};
  for (std::size_t i = 0; i < damages.size(); ++i) {
    damages[i]();
    EXPECT_THAT(frictab({"study", "status"}).out,
                HasSubstr("2 done, 0 failed, 0 missing, 1 damaged"))
        << i;
    const CommandResult check = frictab({"study", "check"});
    EXPECT_EQ(check.exit_code, 1) << i;
    EXPECT_THAT(check.out, HasSubstr("campaign a: results/")) << i;
    frictab({"study", "report"});
    EXPECT_THAT(directory.read("study/campaigns.csv"), HasSubstr("its result is damaged")) << i;
    EXPECT_EQ(frictab({"study", "run"}).out, "1 computed, 2 were there, 0 failed\n") << i;
    EXPECT_EQ(difference("right/results", "study/results"), "") << i;
  }
}

TEST_F(StudyRun, MakesAgainWhatIsExchangedWithAnother) {
  write_three();
  ASSERT_EQ(frictab({"study", "run"}).exit_code, 0);
  const auto plan = test::parse_json(frictab({"study", "plan", "--json"}).out);
  const auto folder = [&](int i) {
    return directory.path("study/results/" + std::string(plan["keys"][i]["key"]));
  };
  fs::rename(folder(0), folder(0) + "x");
  fs::rename(folder(1), folder(0));
  fs::rename(folder(0) + "x", folder(1));
  EXPECT_THAT(frictab({"study", "status"}).out,
              HasSubstr("damaged: a: study.json: it is the result of another campaign"));
  EXPECT_EQ(frictab({"study", "run"}).out, "2 computed, 1 were there, 0 failed\n");
  EXPECT_EQ(frictab({"study", "check"}).exit_code, 0);
}

// The campaigns before it take long enough for the files of the last to change.
TEST_F(SlowStudyRun, StoresNoResultUnderTheKeyOfOtherBytes) {
  write_three();
  directory.write("job.toml", "[models]\nuse = [\"coulomb\", \"orowan\", \"levanov\"]\n"
                              "[calibration]\nbootstrap = 20000\n");
  const auto before = test::parse_json(frictab({"study", "plan", "--json"}).out);
  const CommandResult run = test::run_command(
      {"sh", "-c",
       "'" + test::program() +
           "' study run -j1 & while [ -z \"$(ls study/results 2>/dev/null)\" ]; do sleep 0.01; "
           "done\n"
           "cp a/training.csv b/training.csv; cp a/training.csv c/training.csv; wait $!"},
      directory.path());
  EXPECT_EQ(run.exit_code, 3);
  const CommandResult status = frictab({"study", "status"});
  for (const std::string name : {"b", "c"}) {
    const std::string file = name + "/training.csv";
    EXPECT_THAT(directory.read("study/failed/" +
                               std::string(before["keys"][name == "b" ? 1 : 2]["key"]) + ".json"),
                HasSubstr(file))
        << file;
  }
}

// What ended that process may end this one.
TEST_F(StudyRun, ComputesLastWhatAnotherProcessBeganAndDidNotEnd) {
  directory.write("study.toml", test::twin_study(3));
  const auto plan = test::parse_json(frictab({"study", "plan", "--json"}).out);
  const std::string first = plan["keys"][0]["key"];
  directory.write("study/results/." + first + ".AAAAAA/part", "of a result");
  ASSERT_EQ(frictab({"study", "run"}).exit_code, 0);
  const auto written = [&](const std::string& key) {
    return fs::last_write_time(directory.path("study/results/" + key + "/study.json"));
  };
  for (const int other : {1, 2})
    EXPECT_LT(written(plan["keys"][other]["key"]), written(first));
  EXPECT_EQ(results(), 3u) << "what was left is removed";
}

TEST_F(StudyRun, ReportsTheSameBytesAgain) {
  directory.write("study.toml", test::twin_study(3));
  ASSERT_EQ(frictab({"study", "run"}).exit_code, 0);
  ASSERT_EQ(frictab({"study", "report"}).exit_code, 0);
  const std::string page = directory.read("study/report.html"),
                    table = directory.read("study/campaigns.csv");
  ASSERT_EQ(frictab({"study", "report", "-j1"}).exit_code, 0);
  EXPECT_EQ(directory.read("study/report.html"), page);
  EXPECT_EQ(directory.read("study/campaigns.csv"), table);
}

TEST_F(StudyRun, OfWhichNothingIsThereIsNotReported) {
  directory.write("study.toml", test::twin_study(2));
  ASSERT_EQ(frictab({"study", "run"}).exit_code, 0);
  const CommandResult elsewhere = frictab({"study", "report", "-o", "elsewhere"});
  EXPECT_EQ(elsewhere.exit_code, 2);
  EXPECT_THAT(elsewhere.err, HasSubstr("error: there is no result in "));
  EXPECT_THAT(elsewhere.err, HasSubstr("give the -o, --stage and --set it had"));
  EXPECT_FALSE(fs::exists(directory.path("elsewhere")));
}

TEST_F(SlowStudyRun, ThatIsKilledIsFinishedByTheNextToTheSameBytes) {
  directory.write("study.toml", test::twin_study(24));
  ASSERT_EQ(frictab({"study", "run", "-j1", "-o", "whole"}).exit_code, 0);
  const std::string script = "mkdir -p study/results\n" + test::program() +
                             " study run -j1 -q &\npid=$!\n"
                             "until [ $(ls study/results | wc -l) -ge 3 ]; do sleep 0.01; done\n"
                             "kill -9 $pid; wait $pid; [ $? = 137 ]\n";
  ASSERT_EQ(test::run_command({"sh", "-c", script}, directory.path()).exit_code, 0);
  ASSERT_GE(results(), 3u);
  const auto json = test::parse_json(frictab({"study", "run", "--json"}).out);
  EXPECT_EQ(json["failed"], 0);
  EXPECT_GE(json["computed"].get<int>() + json["there"].get<int>(), 24);
  EXPECT_EQ(difference("whole/results", "study/results"), "") << "nothing of the killed one stays";
}

TEST_F(SlowStudyRun, OfTwoProcessesAtOnceWritesTheSameBytesAsOne) {
  directory.write("study.toml", test::twin_study(12));
  ASSERT_EQ(frictab({"study", "run", "-j1", "-o", "whole"}).exit_code, 0);
  const std::string both = test::program() + " study run -j1 & " + test::program() +
                           " study run -j1; a=$?; wait $!; [ $a$? = 00 ]";
  const CommandResult result = test::run_command({"sh", "-c", both}, directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(difference("whole/results", "study/results"), "");
}

TEST_F(SlowStudyRun, ThroughAllStagesHasTablesAndRoutines) {
  directory.write("study.toml", test::twin_study(1));
  ASSERT_EQ(frictab({"study", "run", "--stage", "run", "--set", "table.tolerance_MPa=5"}).exit_code,
            0);
  std::size_t tables = 0;
  for (const auto& entry : fs::recursive_directory_iterator(directory.path("study/results")))
    tables += entry.path().extension() == ".h5";
  EXPECT_EQ(tables, 1u);
}

} // namespace
} // namespace frictab::study_run_test
