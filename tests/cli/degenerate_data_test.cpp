// Campaigns in which nothing is left to fit or to search: a message or a result, never a crash.
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/run_command.h"

namespace frictab::degenerate_data_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;

struct Row {
  double load, psi, speed, flow_stress, tau;
};

class DegenerateData : public testing::Test {
protected:
  // SYNTHETIC: 8 tests of 12 rows, `change` applied to every row.
  void campaign(const std::function<void(Row&, int test, int row)>& change,
                const std::string& models, const std::string& more = "") {
    for (const char* part : {"training", "validation"}) {
      std::string text = "experiment,sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,sigma_f_MPa,tau_R_MPa,"
                         "batch,origin\n";
      for (int test = 0; test < 8; ++test)
        for (int i = 0; i < 12; ++i) {
          Row row{600.0 + 150 * test + i, 1.0 + 0.4 * (test % 3) + 0.01 * i, 5.0 + 20 * (test % 4),
                  500, 0};
          row.tau = 0.08 * row.load * (1 + 0.02 * std::sin(7.0 * test + i));
          change(row, test, i);
          text += fmt::format("{}{},{},{},{},20,{},{},{},synthetic\n", part[0], test, row.load,
                              row.psi, row.speed, row.flow_stress, row.tau, test % 2);
        }
      directory.write(std::string(part) + ".csv", text);
    }
    directory.write("job.toml",
                    "[data]\ntraining = \"training.csv\"\nvalidation = \"validation.csv\"\n" +
                        more + "[models]\nuse = [" + models +
                        "]\n[table]\ntolerance_MPa = 2.0\n[export]\ntargets = [\"c\"]\n");
  }
  CommandResult run() { return run_frictab({"run", "job.toml"}, directory.path()); }

  TemporaryDirectory directory;
};

TEST_F(DegenerateData, AllStressesAboveShearYieldAreFittedWhereTheUserInsists) {
  campaign([](Row& r, int, int i) { r.tau = 2 * r.flow_stress + i % 7; }, "\"coulomb\", \"shear\"",
           "allow_implausible = [\"shear_yield\", \"friction_coefficient\"]\n");
  const CommandResult result = run();
  EXPECT_LE(result.exit_code, 2) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("rror: std::")));
}

TEST_F(DegenerateData, StressesInPascalAreFittedWhereTheUserInsists) {
  campaign([](Row& r, int, int) { r.tau *= 1e6; }, "\"coulomb\", \"shear\", \"wanheim_bay\"",
           "allow_implausible = [\"shear_yield\", \"friction_coefficient\"]\n");
  EXPECT_LE(run().exit_code, 2);
}

TEST_F(DegenerateData, NoLoadAtAll) {
  campaign([](Row& r, int, int) { r.load = 0; }, "\"coulomb\", \"shear\", \"wanheim_bay\"",
           "allow_implausible = [\"friction_coefficient\"]\n");
  EXPECT_LE(run().exit_code, 2);
}

TEST_F(DegenerateData, FlowStressOfZeroIsNamed) {
  campaign(
      [](Row& r, int test, int i) {
        if (test == 3 && i == 4) r.flow_stress = 0;
      },
      "\"wanheim_bay\", \"shaw\", \"coulomb\"");
  const CommandResult result = run();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("training.csv:42:"));
  EXPECT_THAT(result.err, HasSubstr("sigma_f_MPa"));
}

TEST_F(DegenerateData, NoFrictionAtAll) {
  campaign([](Row& r, int, int) { r.tau = 0; }, "\"coulomb\", \"shear\"",
           "allow_implausible = [\"friction_coefficient\", \"stuck_channel\"]\n");
  EXPECT_LE(run().exit_code, 2);
}

TEST_F(DegenerateData, OneTestUnderManyNamesIsRefusedUnlessTheUserInsists) {
  const auto same = [](Row& r, int, int i) {
    r.load = 600.0 + 10 * i, r.psi = 1.0 + 0.1 * i, r.speed = 5;
    r.tau = 0.08 * r.load * (1 + 0.02 * std::sin(7.0 * i));
  };
  campaign(same, "\"coulomb\", \"shear\"");
  const CommandResult refused = run();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("job.toml:2:12: error: test 't1' has the rows of test 't0', value by value "
                        "(and 6 more tests) (96 of 96 rows)\n"
                        "  hint: no test is measured twice alike: keep one (is a file there under "
                        "two names?); if it is right: data.allow_implausible = "
                        "[\"copied_test\"]\n"));
  campaign(same, "\"coulomb\", \"shear\"", "allow_implausible = [\"copied_test\"]\n");
  const CommandResult allowed = run();
  EXPECT_LE(allowed.exit_code, 1) << allowed.err;
  EXPECT_THAT(allowed.err, HasSubstr("8 of 8 validation experiments have the rows of a training "
                                     "experiment"));
}

} // namespace
} // namespace frictab::degenerate_data_test
