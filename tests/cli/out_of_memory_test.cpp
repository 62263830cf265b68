// Memory that runs out: which file, how many rows, what a row takes, what would help; nothing is
// left behind.
#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/large_work.h"
#include "support/run_command.h"

namespace frictab::out_of_memory_test {
namespace {

using test::CommandResult;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::MatchesRegex;

TEST(LargeWork, SaysWhatTheInnermostWasDoing) {
  const auto no_memory = []() -> int { throw std::bad_alloc(); };
  try {
    large_work("with 7 rows in memory", 7, "fewer rows",
               [&] { return large_work("reading a.csv", 0, "a smaller file", no_memory); });
    FAIL() << "it ran out of memory and nothing was thrown";
  } catch (const OutOfMemory& error) {
    EXPECT_THAT(error.what(), MatchesRegex("out of memory reading a.csv: .*B were in use"));
    EXPECT_EQ(error.hint(), "a smaller file");
  }
}

TEST(LargeWork, SaysWhatARowTakes) {
  const auto no_memory = [] { throw std::bad_alloc(); };
  try {
    large_work("with 1,000 rows in memory", 1000, "fewer rows", no_memory);
    FAIL() << "it ran out of memory and nothing was thrown";
  } catch (const OutOfMemory& error) {
    EXPECT_THAT(error.what(),
                MatchesRegex("out of memory with 1,000 rows in memory: .*, [0-9]+ bytes a row"));
  }
}

TEST(LargeWork, GivesWhatTheWorkReturns) {
  EXPECT_EQ(large_work("counting", 0, "", [] { return 3; }), 3);
}

// SYNTHETIC: 40 tests of 10,000 rows.
std::string many_rows() {
  std::string text = "experiment,sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,sigma_f_MPa,tau_R_MPa\n";
  for (int test = 0; test < 40; ++test)
    for (int row = 0; row < 10000; ++row)
      text += fmt::format("t{},{},{},{},{},500,{}\n", test, 600 + 20 * test + 0.001 * row,
                          1 + 0.1 * (test % 5), 5 + 20 * (test % 4), 20 + 10 * (test % 3),
                          0.08 * (600 + 20 * test) + 0.001 * (row % 17));
  return text;
}

// (Not with sanitizers, whose own memory no limit of ours holds.)
TEST(SlowOutOfMemory, NamesFileOrRowsAndLeavesNothingBehind) {
  const TemporaryDirectory directory;
  directory.write("big.csv", many_rows());
  directory.write("job.toml", "[data]\ntraining = \"big.csv\"\n[models]\nuse = [\"coulomb\"]\n"
                              "[output]\ndirectory = \"out\"\n");
  const auto within_MiB = [&](int limit) {
    return test::run_command(
        {"sh", "-c",
         fmt::format("ulimit -v {}; exec '{}' calibrate '{}' -q -j1", limit * 1024, test::program(),
                     directory.path("job.toml"))});
  };
  int named = 0;
  for (int limit = 80; limit <= 260; limit += 30) {
    std::filesystem::remove_all(directory.path("out")); // of a lower limit that was enough
    const CommandResult result = within_MiB(limit);
    if (result.exit_code == 0) continue;
    EXPECT_EQ(result.exit_code, 3) << limit << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr("error: out of memory ")) << limit;
    EXPECT_THAT(result.err, HasSubstr("\n  hint: ")) << limit;
    EXPECT_FALSE(std::filesystem::exists(directory.path("out/calibration.json")));
    named += result.err.find("reading big.csv (") != std::string::npos ||
             result.err.find(" bytes a row") != std::string::npos;
  }
  EXPECT_GE(named, 2);
}

} // namespace
} // namespace frictab::out_of_memory_test
