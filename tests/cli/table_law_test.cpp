// A law that is a table goes the whole way, and is judged and delivered like the others.
#include <cstdio>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/small_campaign.h"

namespace frictab::table_law_test {
namespace {

using test::CommandResult;
using testing::HasSubstr;

class LongTableLaw : public test::SmallCampaign {
protected:
  // Speeds in the data reach from 5 to 500.
  void write_table(double scale = 1) const {
    std::string csv = "v_rel_mm_s,psi,mu\n";
    for (const double v : {2.0, 20.0, 100.0, 200.0})
      for (const double psi : {1.0, 8.0, 30.0})
        csv += fmt::format("{},{},{}\n", v, psi, scale * (0.03 + 0.2 / (3 + v) + 0.001 * psi));
    directory.write("paper.csv", csv);
  }
  void write_table_job(const std::string& more) const {
    write_job("[models]\nuse = [\"coulomb\", \"paper\"]\n[models.paper]\ntable = \"paper.csv\"\n"
              "interpolation = \"linear\"\nlog_axes = [\"v_rel_mm_s\"]\n" +
              more);
  }
  nlohmann::json fit() const {
    const auto file = nlohmann::json::parse(directory.read("out/calibration.json"));
    for (const auto& one : file.at("models"))
      if (one.at("name") == "paper") return one;
    return {};
  }
};

TEST_F(LongTableLaw, GoesTheWholeWayToEveryTarget) {
  write_table();
  write_table_job("[table]\nmodel = \"paper\"\n[export]\ntargets = \"all\"\n");
  const CommandResult all = frictab({"export", "job.toml"});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(fit().at("termination"), "not calibrated");
  EXPECT_THAT(directory.read("out/models/paper.json"), HasSubstr("minimum(maximum(v_rel_mm_s, "));
  const CommandResult explained = frictab({"explain", "paper", "--job", "job.toml"});
  EXPECT_THAT(explained.out, HasSubstr("value = mu of paper.csv, linear\n"
                                       "                between its nodes over v_rel_mm_s (log, 4 "
                                       "nodes), psi (linear, 3\n"
                                       "                nodes), held at their ends\n"));
  EXPECT_THAT(explained.out, HasSubstr("no: a table, taken as it is"));

  for (const char* form : {"table", "direct"}) {
    write_table_job(fmt::format("[table]\nmodel = \"paper\"\n[export]\nform = \"{}\"\n"
                                "targets = [\"c\", \"abaqus_vfric\"]\n",
                                form));
    const CommandResult run = frictab({"run", "job.toml"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto verified = nlohmann::json::parse(directory.read("out/verify.json"));
    EXPECT_TRUE(verified.at("passed").get<bool>()) << form;
  }
}

TEST_F(LongTableLaw, IsTabulatedOnItsOwnNodesToRounding) {
  write_table();
  write_table_job("[table]\nmodel = \"paper\"\n");
  ASSERT_EQ(frictab({"tabulate", "job.toml"}).exit_code, 0);
  const CommandResult verified =
      frictab({"verify", "--table", "out/tables/paper.h5", "--model", "out/models/paper.json",
               "--data", "data/validation.csv", "--max-drift-MPa", "1e-9"});
  EXPECT_EQ(verified.exit_code, 0) << verified.err << verified.out;
  const CommandResult info = frictab({"table", "info", "out/tables/paper.h5", "--json"});
  for (const auto& axis : nlohmann::json::parse(info.out).at("axes")) {
    if (axis.at("name") != "v_rel_mm_s") continue;
    EXPECT_EQ(axis.at("nodes").dump(), "[5.0,20.0,100.0,200.0,500.0]");
  }
}

TEST_F(LongTableLaw, StandsAloneInItsModelFile) {
  write_table();
  write_table_job("[table]\nmodel = \"paper\"\n[export]\ntargets = [\"c\"]\n");
  ASSERT_EQ(frictab({"run", "job.toml"}).exit_code, 0);
  std::remove(directory.path("paper.csv").c_str());
  const CommandResult verified =
      frictab({"verify", "--table", "out/tables/paper.h5", "--model", "out/models/paper.json",
               "--data", "data/validation.csv", "--max-drift-MPa", "0.5"});
  EXPECT_EQ(verified.exit_code, 0) << verified.err << verified.out;
  const CommandResult predicted =
      frictab({"predict", "out/models/paper.json", "data/validation.csv", "-o", "p.csv"});
  EXPECT_EQ(predicted.exit_code, 0) << predicted.err;
}

TEST_F(LongTableLaw, SaysWhichRowsLieBeyondItsAxes) {
  write_table();
  write_table_job("");
  const CommandResult result = frictab({"calibrate", "job.toml"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(fit().at("remarks").dump(),
            "[\"40 of 80 training rows lie beyond the ends at which the law is held: v_rel_mm_s "
            "above 200 (40)\"]");
  EXPECT_THAT(result.out, HasSubstr("lie beyond the ends at which the law is held"));
}

TEST_F(LongTableLaw, IsReadAgainWhenItsFileHasChanged) {
  write_table();
  write_table_job("[table]\nmodel = \"paper\"\n");
  ASSERT_EQ(frictab({"tabulate", "job.toml"}).exit_code, 0);
  const std::string before = directory.read("out/tables/paper.h5");
  const double error = fit().at("validation").at("mae_MPa");
  write_table(1.5);
  const CommandResult stale = frictab({"tabulate", "job.toml"});
  EXPECT_EQ(stale.exit_code, 2);
  EXPECT_THAT(stale.err,
              HasSubstr("is stale: [models] or [calibration] of the job has changed since"));
  ASSERT_EQ(frictab({"calibrate", "job.toml"}).exit_code, 0);
  ASSERT_EQ(frictab({"tabulate", "job.toml"}).exit_code, 0);
  EXPECT_NE(fit().at("validation").at("mae_MPa").get<double>(), error);
  EXPECT_FALSE(directory.read("out/tables/paper.h5") == before);
}

TEST_F(LongTableLaw, NeedsItsInterpolationStated) {
  write_table();
  write_job("[models.paper]\ntable = \"paper.csv\"\n");
  EXPECT_EQ(frictab({"calibrate", "job.toml"}).err,
            "job.toml:5:9: error: law paper does not say how its table is interpolated\n"
            "  hint: interpolation = \"linear\"\n");
  write_job("[models.paper]\ntable = \"paper.csv\"\ninterpolation = \"cubic\"\n");
  EXPECT_THAT(frictab({"calibrate", "job.toml"}).err, HasSubstr("job.toml:6:17: error: "));
  write_job("[models.paper]\ntable = \"none.csv\"\ninterpolation = \"linear\"\n");
  EXPECT_THAT(frictab({"calibrate", "job.toml"}).err, HasSubstr("none.csv"));
}

} // namespace
} // namespace frictab::table_law_test
