// table.range through the commands: what axes reach, and where nodes beyond the data are told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/hdf5.h"
#include "support/json.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "support/traced_law.h"

namespace frictab::table_range_test {
namespace {

using test::run_frictab;
using testing::HasSubstr;
using testing::Not;

// A campaign that stops at psi 10, and one law on it.
class TableRange : public testing::Test {
protected:
  void SetUp() override {
    data::Dataset data = test::sample_data(test::plausible_model(*models::find_law("log_coulomb")));
    for (data::Column& column : data.columns)
      for (std::size_t i = 0; column.name == "psi" && i < data.rows(); ++i)
        column.values[i] = 1 + 9 * static_cast<double>(i % 60) / 59;
    directory.write("training.csv", test::csv_of(data));
    job = directory.write("job.toml", "[data]\ntraining = \"training.csv\"\n"
                                      "allow_implausible = [\"speed\"]\n"
                                      "[models]\nuse = [\"exp_coulomb\", \"wzl\"]\n"
                                      "[table]\nmodel = \"wzl\"\n");
    const auto result = run_frictab({"calibrate", job, "-q"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  test::CommandResult run(const std::string& stage, const std::string& range) {
    auto result = run_frictab({stage, job, "--set", "table.range=" + range});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result;
  }

  test::TemporaryDirectory directory;
  std::string job;
};

TEST_F(TableRange, NothingIsBeyondTheDataByDefault) {
  const auto result = run_frictab({"tabulate", job});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("beyond the data")));
  // But for the last line, which repeats what the command line said.
  const std::string said = run("tabulate", "data").out;
  EXPECT_EQ(said.substr(0, said.find("next: ")), result.out.substr(0, result.out.find("next: ")));
}

TEST_F(TableRange, NodesBeyondTheDataStandInSummaryInfoAndReport) {
  const std::string told = "nodes (100 %) beyond the data: from ";
  EXPECT_THAT(run("tabulate", "table1").out, HasSubstr("T_contact_C: 2 of 2 " + told));
  EXPECT_THAT(run_frictab({"table", "info", directory.path("out/tables/wzl.h5")}).out,
              HasSubstr(" 20 .. 200 degC, 2 nodes, even in ln T; 2 of 2 " + told));
  run("report", "table1");
  EXPECT_THAT(directory.read("out/report.html"), HasSubstr("T_contact_C: 2 of 2 " + told));
  const auto json =
      test::parse_json(run_frictab({"tabulate", job, "--json", "--set", "table.range=table1"}).out);
  EXPECT_GT(json["tables"][0]["axes"][0]["share_beyond_data"], 0.0);
}

TEST_F(TableRange, RangeOfTheJobBeyondTheDataIsToldAsWell) {
  const auto result = run_frictab(
      {"tabulate", job, "--set", "table.axes.v_rel_mm_s={range = [1, 1000], nodes = 2}"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("beyond the data: from "));
  EXPECT_THAT(result.out, HasSubstr(" down to 1, from "));
  EXPECT_THAT(result.out, HasSubstr(" up to 1000 mm/s\n"));
}

TEST_F(TableRange, WhatIsFarFromEveryTestStandsInSummaryInfoAndReports) {
  const std::string told = " % of the table extrapolates: less than half a test within";
  EXPECT_THAT(run("tabulate", "table1").out, HasSubstr(told));
  EXPECT_THAT(run_frictab({"table", "info", directory.path("out/tables/wzl.h5")}).out,
              HasSubstr(told));
  run("report", "table1");
  EXPECT_THAT(directory.read("out/report.html"), HasSubstr(told));
  EXPECT_THAT(directory.read("out/report.md"),
              testing::ContainsRegex("\n## Tables\n(.*\n)+- wzl: .*" + told));
  const auto result = run_frictab({"tabulate", job, "--set", "table.distance=false"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr(told)));
}

TEST_F(TableRange, OtherWordsAreRefused) {
  const auto result = run_frictab({"tabulate", job, "--set", "table.range=paper"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("error: table.range must be \"data\" or \"table1\", not the "
                                    "text \"paper\"\n  hint: "));
}

} // namespace
} // namespace frictab::table_range_test
