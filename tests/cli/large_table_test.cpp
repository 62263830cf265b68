// Jobs whose tables have millions of nodes: verified, refused where a source cannot hold them.
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::large_table_test {
namespace {

namespace fs = std::filesystem;
using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;

// 3,000,000 nodes, 23 MiB.
const char* const job_text = R"([data]
training = "data/training.csv"
[models]
use = ["log_coulomb"]
[table]
model = "log_coulomb"
interpolation = "linear"
[table.axes]
sigma_n_MPa = { nodes = 50 }
psi = { nodes = 40 }
v_rel_mm_s = { nodes = 60 }
T_contact_C = { nodes = 25 }
[export]
targets = []
)";

class LongLargeTable : public testing::Test {
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

TEST_F(LongLargeTable, IsVerifiedByTheJobAndAlone) {
  const std::vector<std::string> with_sums = {"--set", "table.hdf5.fletcher32=true"};
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

TEST_F(LongLargeTable, TargetsThatCannotHoldItAreRefusedAndNothingIsWritten) {
  // Values, nodes and constants.
  const std::string what = ": the table of log_coulomb needs 3,000,";
  const std::string why =
      " numbers in the source; a compiler takes 300,000 in reasonable time and memory\n";
  const CommandResult whole = run("run", {"--set", "export.targets=\"qform_lua\""});
  EXPECT_EQ(whole.exit_code, 2);
  EXPECT_THAT(whole.err, testing::AllOf(testing::StartsWith("error: qform_lua" + what),
                                        testing::HasSubstr(why)));
  EXPECT_FALSE(fs::exists(directory.path("out/tables")));
  ASSERT_EQ(run("tabulate").exit_code, 0);
  const CommandResult sources =
      run("export", {"--set", "export.targets=\"c\"", "--set", "export.options.values=\"source\""});
  EXPECT_EQ(sources.exit_code, 2);
  EXPECT_THAT(sources.err,
              testing::AllOf(testing::StartsWith("error: c" + what), testing::HasSubstr(why)));
}

TEST_F(LongLargeTable, SourceReadsItsValuesFromAFileAndIsVerifiedWithThem) {
  const std::vector<std::string> set = {"--set", "export.targets=[\"c\",\"fortran\"]"};
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

} // namespace
} // namespace frictab::large_table_test
