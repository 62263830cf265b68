// A read that fails ends the command with a message: it is never the end of a file.
#include <filesystem>

#include <gmock/gmock.h>

#include "support/small_campaign.h"

namespace frictab::failing_reads_test {
namespace {

using test::CommandResult;

class LongFailingReads : public test::SmallCampaign {
protected:
  // Every read of the command fails in turn. Returns how many it has.
  int fail_each(const std::vector<std::string>& command) {
    const CommandResult usual = frictab(command);
    EXPECT_EQ(usual.exit_code, 0) << usual.err;
    for (int n = 1; n < 3000; ++n) {
      const std::string seen = directory.path("seen");
      const CommandResult result =
          frictab(command, {"LD_PRELOAD=" + test::failing_disk(), "FAIL_READS=1",
                            "FAIL_AT=" + std::to_string(n), "FAIL_SEEN=" + seen});
      if (!std::filesystem::remove(seen)) return n - 1;
      EXPECT_TRUE(result.exit_code == 2 || result.exit_code == 3 || result.out == usual.out)
          << command[0] << ", read " << n << ": another answer with " << result.exit_code;
      if (result.exit_code != 0) {
        EXPECT_THAT(result.err, testing::HasSubstr("error: "));
      }
    }
    ADD_FAILURE() << "it never ends";
    return 0;
  }
};

TEST_F(LongFailingReads, GiveNoOtherAnswer) {
  write_job("[models]\nuse = [\"coulomb\", \"shear\"]\n"
            "[table]\nmodel = \"shear\"\n[export]\ntargets = [\"c\"]\n" +
            std::string(test::no_causes));
  directory.write("study.toml", "job = \"job.toml\"\nstage = \"calibrate\"\n[[campaign]]\n"
                                "name = \"one\"\nfiles = \"data/training.csv\"\n");
  ASSERT_EQ(frictab({"run", "job.toml", "-q"}).exit_code, 0);
  ASSERT_EQ(frictab({"study", "run", "-q"}).exit_code, 0);
  for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
           {"data", "job.toml", "--json"},
           {"status", "job.toml", "--json"},
           {"status", "job.toml", "--check"},
           {"study", "plan", "--json"},
           {"study", "status", "--json"},
           {"study", "check"},
           {"predict", "out/models/shear.json", "data/validation.csv"},
           {"table", "info", "out/tables/shear.h5", "--json"}})
    EXPECT_GT(fail_each(command), 1) << command[0] << ' ' << command[1];
}

} // namespace
} // namespace frictab::failing_reads_test
