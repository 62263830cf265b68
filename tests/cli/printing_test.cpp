// What cannot be printed or written is told, wherever it fails; options that say nothing are
// refused.
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/small_campaign.h"

namespace frictab::printing_test {
namespace {

using test::CommandResult;
using test::run_command;
using testing::AllOf;
using testing::HasSubstr;

class Printing : public test::SmallCampaign {
protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(SmallCampaign::SetUp());
    write_job(std::string("[models]\nuse = [\"coulomb\"]\n[export]\ntargets = [\"c\"]\n") +
              test::no_causes);
  }
};

TEST_F(Printing, OntoAFullDiskEndsWithAMessageAndCode3) {
  for (const char* arguments :
       {"--version", "--help", "twin --help", "list models", "list effects --json",
        "explain coulomb", "explain coulomb --json", "data job.toml", "data job.toml --json",
        "calibrate job.toml", "calibrate job.toml --json", "status job.toml", "doctor", "twin twin",
        "twin twin2 --json", "init new"}) {
    const CommandResult result = run_command(
        {"sh", "-c", test::program() + " " + arguments + " > /dev/full"}, directory.path());
    EXPECT_EQ(result.exit_code, 3) << arguments;
    EXPECT_THAT(result.err, AllOf(HasSubstr("error: what was to be printed cannot be written"),
                                  HasSubstr("hint: ")))
        << arguments;
  }
}

TEST_F(Printing, OfATableOntoAFullDiskIsNoSuccess) {
  ASSERT_EQ(frictab({"tabulate", "job.toml", "-q"}).exit_code, 0);
  for (const char* arguments : {"table info out/tables/coulomb.h5",
                                "table slice out/tables/coulomb.h5 --at sigma_n_MPa=1000"}) {
    const CommandResult result = run_command(
        {"sh", "-c", test::program() + " " + arguments + " > /dev/full"}, directory.path());
    EXPECT_NE(result.exit_code, 0) << arguments;
    EXPECT_THAT(result.err, HasSubstr("error: ")) << arguments;
  }
}

TEST_F(Printing, OfANumberThatDoesNotFitAnOptionIsRefusedWithItsRange) {
  for (const char* seed : {"-1", "99999999999999999999", "9223372036854775808", "1.5", "1e3", ""}) {
    const CommandResult result = frictab({"calibrate", "job.toml", "--seed", seed});
    EXPECT_EQ(result.exit_code, 2) << seed;
    EXPECT_THAT(result.err, HasSubstr("not a whole number from 0 to 9223372036854775807")) << seed;
  }
  for (const char* threads : {"-1", "100000000", "4294967297", "two"}) {
    const CommandResult result = frictab({"list", "models", "-j", threads});
    EXPECT_EQ(result.exit_code, 2) << threads;
    EXPECT_THAT(result.err, HasSubstr("not a whole number from 0 to 1024")) << threads;
  }
  EXPECT_EQ(frictab({"calibrate", "job.toml", "--seed", "9223372036854775807"}).exit_code, 0);
}

TEST_F(Printing, IntoADirectoryWithoutANameIsRefused) {
  for (const char* command : {"run", "calibrate", "status", "data"}) {
    const CommandResult result = frictab({command, "job.toml", "-o", ""});
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_THAT(result.err, HasSubstr("-o: error: the output directory has an empty name"))
        << command;
  }
}

TEST_F(Printing, ANulCharacterInATextOfAJobIsRefusedWithItsPlace) {
  directory.write("nul.toml", "[data]\ntraining = \"data/training.csv\\u0000.h5\"\n"
                              "validation = [\"data/validation.csv\", \"a\\u0000\"]\n"
                              "[output]\ndirectory = \"o\\u0000ut\"\n");
  const CommandResult result = frictab({"data", "nul.toml"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("nul.toml:2:12: error: data.training holds a NUL character"));
  EXPECT_THAT(result.err, HasSubstr("nul.toml:3:38: error: data.validation holds a NUL character"));
  EXPECT_THAT(result.err,
              HasSubstr("nul.toml:5:13: error: output.directory holds a NUL character"));
}

TEST_F(Printing, AnEmptyTmpdirMeansTmpAndOneThatIsNotThereIsNamed) {
  const CommandResult empty = frictab({"run", "job.toml", "-q"}, {"TMPDIR="});
  EXPECT_EQ(empty.exit_code, 0) << empty.err;
  const CommandResult none = frictab({"verify", "job.toml", "-q"}, {"TMPDIR=/nowhere/at/all"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("TMPDIR: error: no temporary directory can be made in "
                                        "/nowhere/at/all: No such file or directory"),
                              HasSubstr("hint: set TMPDIR to a directory that can be written")));
}

TEST_F(Printing, ACountInAResultFileThatIsNoneIsNamed) {
  ASSERT_EQ(frictab({"run", "job.toml", "-q"}).exit_code, 0);
  std::filesystem::remove(directory.path("out/stages.json")); // which knows what was changed
  const std::string text = directory.read("out/verify.json");
  const std::string key = "\"n_refused\": 0";
  const std::size_t at = text.find(key);
  ASSERT_NE(at, text.npos);
  for (const char* count : {"5.5e24", "-1", "0.5", "18446744073709551615"}) {
    std::string other = text;
    other.replace(at, key.size(), std::string("\"n_refused\": ") + count);
    directory.write("out/verify.json", other);
    const CommandResult result = frictab({"report", "job.toml", "-q"});
    EXPECT_THAT(result.err, HasSubstr("is not a count")) << count;
    EXPECT_EQ(result.exit_code, 2) << count << result.err;
  }
}

} // namespace
} // namespace frictab::printing_test
