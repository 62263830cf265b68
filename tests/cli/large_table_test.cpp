// Jobs whose tables are sampled to disk: killed and run again, verified, refused where too large.
#include <filesystem>
#include <regex>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::large_table_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_command;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;

// 12,000,000 nodes in 12 chunks, 92 MiB; a quarter of them where the chunks are not the matter.
const char* const job_text = R"([data]
training = "data/training.csv"
[models]
use = ["log_coulomb"]
[table]
model = "log_coulomb"
memory_limit_MiB = 1.0
[table.axes]
sigma_n_MPa = { nodes = 50 }
psi = { nodes = 40 }
v_rel_mm_s = { nodes = 60 }
T_contact_C = { nodes = 100 }
[export]
targets = []
)";
const char* const quarter = "table.axes.T_contact_C.nodes=25";

class SlowLargeTable : public testing::Test {
protected:
  void SetUp() override {
    ASSERT_EQ(run_frictab({"twin", directory.path("data"), "--seed", "3", "--design",
                           "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=40;validation=6"})
                  .exit_code,
              0);
    directory.write("job.toml", job_text);
    ASSERT_EQ(run("calibrate").exit_code, 0);
  }
  CommandResult run(const char* command, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {command, "job.toml"});
    return run_frictab(more, directory.path());
  }
  // Every file below tables/, hidden ones too.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(directory.path("out/tables")))
      names.push_back(entry.path().filename().string());
    return names;
  }
  TemporaryDirectory directory;
};

TEST_F(SlowLargeTable, KilledRunGoesOnWhereItWasAndGivesTheSameBytes) {
  const std::string script = "'" + test::program() +
                             "' tabulate job.toml -q > /dev/null & pid=$!\n"
                             "while [ \"$(cat out/tables/.log_coulomb.h5.chunks 2> /dev/null | wc "
                             "-l)\" -lt 4 ]; do sleep 0.01; done\n"
                             "kill -9 $pid; wait $pid";
  const CommandResult killed = run_command({"sh", "-c", script}, directory.path());
  EXPECT_EQ(killed.exit_code, 137);
  EXPECT_FALSE(fs::exists(directory.path("out/tables/log_coulomb.h5")));
  const CommandResult resumed = run("tabulate");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr(" of 12 chunks kept from shards or an interrupted run\n"));
  EXPECT_THAT(resumed.out, HasSubstr("log_coulomb    12,000,000 nodes, 91.6 MiB: "));
  EXPECT_EQ(files(), (std::vector<std::string>{"log_coulomb.h5"}));
  fs::rename(directory.path("out/tables/log_coulomb.h5"), directory.path("first.h5"));
  const CommandResult anew = run("tabulate", {"-j", "1"});
  EXPECT_EQ(anew.err, "");
  EXPECT_EQ(run_command({"cmp", "first.h5", "out/tables/log_coulomb.h5"}, directory.path()).out,
            "");
}

TEST_F(SlowLargeTable, FourShardsOneOfThemKilledMakeTheBytesOfOneProcess) {
  ASSERT_EQ(run("tabulate").exit_code, 0);
  fs::rename(directory.path("out/tables/log_coulomb.h5"), directory.path("first.h5"));
  const std::string script = "for i in 1 2 3 4; do\n  '" + test::program() +
                             "' tabulate job.toml -j1 --shard $i/4 > $i.txt & pids=\"$pids $!\"\n"
                             "done\n"
                             "while [ \"$(cat out/tables/.log_coulomb.h5.chunks.4-of-4 2> /dev/null"
                             " | wc -l)\" -lt 2 ]; do sleep 0.002; done\n"
                             "kill -9 $!\nwait";
  run_command({"sh", "-c", script}, directory.path());
  EXPECT_EQ(directory.read("2.txt"),
            "log_coulomb: shard 2/4 sampled, 3,145,728 nodes in 3 chunks\n"
            "next, when all shards are sampled: frictab tabulate job.toml\n");
  EXPECT_FALSE(fs::exists(directory.path("out/tables/log_coulomb.h5")));
  const CommandResult completed = run("tabulate");
  EXPECT_EQ(completed.exit_code, 0) << completed.err;
  EXPECT_THAT(completed.err,
              testing::ContainsRegex("log_coulomb: (10|11|12) of 12 chunks kept from shards or an "
                                     "interrupted run\n"));
  EXPECT_EQ(files(), (std::vector<std::string>{"log_coulomb.h5"}));
  EXPECT_EQ(run_command({"cmp", "first.h5", "out/tables/log_coulomb.h5"}, directory.path()).out,
            "");
}

TEST_F(SlowLargeTable, ShardsWithoutACalibrationOrOfATableInMemoryAreRefused) {
  const CommandResult small =
      run("tabulate", {"--shard", "1/2", "--set", "table.memory_limit_MiB=256.0"});
  EXPECT_EQ(small.exit_code, 2);
  EXPECT_EQ(small.err, "job.toml: error: the table of log_coulomb is made in memory: it has no "
                       "shards\n  hint: without --shard; shards are for tables larger than "
                       "table.memory_limit_MiB, with the nodes of every axis given\n");
  EXPECT_EQ(run("tabulate", {"--shard", "3/2"}).exit_code, 2);
  const CommandResult none = run("tabulate", {"--shard", "1/2", "-o", "elsewhere"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.err,
            "elsewhere/calibration.json: error: is not there: all shards sample the laws "
            "of one calibration\n  hint: `frictab calibrate job.toml -o elsewhere` before "
            "the shards\n");
}

TEST_F(SlowLargeTable, IsVerifiedByTheJobAndAlone) {
  const std::vector<std::string> with_sums = {"--set", quarter, "--set",
                                              "table.hdf5.fletcher32=true"};
  ASSERT_EQ(run("run", with_sums).exit_code, 0);
  EXPECT_EQ(files(), (std::vector<std::string>{"log_coulomb.h5"}));
  EXPECT_EQ(run("verify", with_sums).exit_code, 0);
  const CommandResult alone = run_frictab(
      {"verify", "--table", "out/tables/log_coulomb.h5", "--model", "out/models/log_coulomb.json"},
      directory.path());
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_THAT(run_frictab({"table", "info", "out/tables/log_coulomb.h5"}, directory.path()).out,
              HasSubstr("22.9 MiB of values; 22.9 MiB in the file, chunks of 1 x 40 x 60 x 25, "
                        "fletcher32\n"));
}

TEST_F(SlowLargeTable, TargetsThatCannotHoldItAreRefusedBeforeItIsSampled) {
  // Values, nodes and constants.
  const std::string what = "error: the table of log_coulomb needs 3,000,";
  const std::string why =
      " numbers in the source; a compiler takes 300,000 in reasonable time and memory\n";
  const CommandResult whole =
      run("run", {"--set", quarter, "--set", "export.targets=\"qform_lua\""});
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_THAT(whole.err, testing::AllOf(testing::StartsWith(what), testing::HasSubstr(why)));
  EXPECT_FALSE(fs::exists(directory.path("out/tables")));
  ASSERT_EQ(run("tabulate", {"--set", quarter}).exit_code, 0);
  const CommandResult sources = run("export", {"--set", quarter, "--set", "export.targets=\"c\"",
                                               "--set", "export.options.values=\"source\""});
  EXPECT_EQ(sources.exit_code, 2);
  EXPECT_THAT(sources.err, testing::AllOf(testing::StartsWith(what), testing::HasSubstr(why)));
}

TEST_F(SlowLargeTable, SourceReadsItsValuesFromAFileAndIsVerifiedWithThem) {
  const std::vector<std::string> set = {"--set", quarter, "--set",
                                        "export.targets=[\"c\",\"fortran\"]"};
  const CommandResult whole = run("run", set);
  EXPECT_EQ(whole.exit_code, 0) << whole.err;
  const std::string c = directory.path("out/export/c/");
  EXPECT_EQ(fs::file_size(c + "frictab_values.bin"), 24000000u);
  EXPECT_LT(fs::file_size(c + "frictab_tau_R.c"), 100000u);
  EXPECT_THAT(directory.read("out/verify.json"),
              testing::AllOf(HasSubstr("\"subject\": \"c/c99\""),
                             HasSubstr("\"subject\": \"fortran/f2008\"")));
  EXPECT_EQ(run("verify", set).exit_code, 0); // the sources as they lie there
}

// The first line comes after one second, the next after eleven: where the start takes longer than
// the first and the sampling ends before the second, a larger table shows it.
TEST_F(SlowLargeTable, ProgressSaysHowMuchIsLeftAndQuietIsSilent) {
  EXPECT_EQ(run("tabulate", {"-q", "--progress", "--set", quarter}).err, "");
  bool said = false;
  std::string shown;
  for (const auto& [nodes, steps] : {std::pair{100, 29}, {300, 86}, {600, 172}}) {
    if (said) break;
    const CommandResult result = run("tabulate", {"--progress", "-j", "1", "--set",
                                                  fmt::format("table.axes.psi.nodes={}", nodes)});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    shown += result.err;
    const std::regex left(
        fmt::format("sampling log_coulomb \\[#*\\.*\\] [0-9]+/{}, [0-9]+ s, [0-9]+ s left", steps));
    said = std::regex_search(result.err, left);
  }
  EXPECT_TRUE(said) << shown;
}

} // namespace
} // namespace frictab::large_table_test
