// Laws that are tables, further: from a workbook, over five axes with a recorded column and a
// history among them; traced; on any number of threads.
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run_command.h"
#include "support/workbook.h"

namespace frictab::table_law_trace_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const char* const job_text = R"([data]
training = "data/training.csv"
validation = "data/validation.csv"
[models]
use = ["log_coulomb", "wide", "slid"]
[models.wide]
table = "wide.xlsx"
interpolation = "linear"
log_axes = ["v_rel_mm_s"]
[models.slid]
table = "slid.csv"
interpolation = "linear"
[table]
model = ["wide", "slid_traced"]
[export]
targets = ["c"]
[trace]
models = ["wide", "slid"]
ignore = ["Ra_um", "film_um", "T_tool_C", "tool"]
)";

// The run of one job on a SYNTHETIC campaign, for all claims.
class LongTracedTableLaw : public testing::Test {
protected:
  static void SetUpTestSuite() {
    directory = std::make_unique<test::TemporaryDirectory>();
    ASSERT_EQ(frictab({"twin", "data", "--seed", "3", "--design",
                       "p=1725,2005;psi=1,20;v=5,500;T=20,200;points=12;validation=8"})
                  .exit_code,
              0);
    write_tables();
    const std::string rows = replace_all(directory->read("wide.csv"), ",", ";");
    test::write_workbook(directory->path("wide.xlsx"), {{{"1", test::xml_rows(rows)}}});
    directory->write("job.toml", job_text);
    const auto result = frictab({"run", "job.toml", "-j", "1"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    summary = result.out;
  }
  static void TearDownTestSuite() { directory.reset(); }

  static test::CommandResult frictab(const std::vector<std::string>& arguments) {
    return test::run_frictab(arguments, directory->path());
  }

  static void write_tables() {
    std::string wide = "sigma_n_MPa,v_rel_mm_s,psi,humidity_pct,friction_work,mu\n";
    for (const double p : {500.0, 1500.0, 2500.0})
      for (const double v : {5.0, 500.0})
        for (const double psi : {1.0, 20.0})
          for (const double humidity : {20.0, 80.0})
            for (const double work : {0.0, 2000.0, 9000.0})
              wide += fmt::format("{},{},{},{},{},{}\n", p, v, psi, humidity, work,
                                  0.03 + 30 / p + 0.1 / (3 + v) + 1e-4 * psi + 1e-4 * humidity +
                                      2e-3 * work / (1000 + work));
    directory->write("wide.csv", wide);
    directory->write("slid.csv", "sliding_distance,v_rel_mm_s,mu\n0,5,0.06\n50,5,0.07\n"
                                 "0,500,0.055\n50,500,0.06\n");
  }

  static nlohmann::json json_of(const std::string& file) {
    return nlohmann::json::parse(directory->read(file));
  }

  static std::unique_ptr<test::TemporaryDirectory> directory;
  static std::string summary;
};
std::unique_ptr<test::TemporaryDirectory> LongTracedTableLaw::directory;
std::string LongTracedTableLaw::summary;

TEST_F(LongTracedTableLaw, FromAWorkbookOverFiveAxesIsTabulatedAndVerified) {
  const auto info =
      nlohmann::json::parse(frictab({"table", "info", "out/tables/wide.h5", "--json"}).out);
  std::vector<std::string> axes;
  for (const auto& axis : info.at("axes"))
    axes.push_back(axis.at("name"));
  EXPECT_THAT(axes, testing::UnorderedElementsAre("sigma_n_MPa", "v_rel_mm_s", "psi",
                                                  "humidity_pct", "friction_work"));
  const auto verified = json_of("out/verify.json");
  EXPECT_TRUE(verified.at("passed").get<bool>());
  EXPECT_THAT(directory->read("out/export/c/wide/recipe.json"), HasSubstr("friction_work"));
}

// slid knows no pressure, and mu of the campaign falls with it.
TEST_F(LongTracedTableLaw, IsDeliveredWithTheEffectThatTheTraceFinds) {
  const auto model = json_of("out/models/slid_traced.json");
  EXPECT_THAT(model.dump(), HasSubstr("sigma_n_MPa"));
  const auto traces = json_of("out/trace.json");
  EXPECT_THAT(traces.dump(), HasSubstr("\"model\":\"slid\""));
  EXPECT_THAT(traces.dump(), HasSubstr("effect_added"));
  EXPECT_THAT(summary, HasSubstr("slid_traced"));
}

TEST_F(LongTracedTableLaw, GivesTheSameBytesOnFourThreads) {
  const auto result = frictab({"run", "job.toml", "-j", "4", "-o", "again"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto diff = test::run_command({"/usr/bin/diff", "-rq", "out", "again"}, directory->path());
  EXPECT_EQ(diff.out, "");
}

} // namespace
} // namespace frictab::table_law_trace_test
