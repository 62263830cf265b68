// How far a table may drift where the job does not say it: a share of what its law errs by.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/random.h"
#include "support/json.h"
#include "support/run_command.h"
#include "table/tolerance.h"

namespace frictab::auto_tolerance_test {
namespace {

using test::CommandResult;
using test::TemporaryDirectory;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Twelve tests of a foil or a gel: mu over ln v is a curve, and every stress is `scale` times that
// of forming.
struct Tolerance : testing::Test {
  void write_campaign(double scale, const std::string& sections, double noise = 0.01) const {
    std::string rows = "test,p_MPa,v_mm_s,mu\n";
    Random random(7);
    for (int t = 0; t < 12; ++t) {
      const double gain = 1 + noise * random.normal();
      for (int i = 0; i < 30; ++i) {
        const double v = std::pow(10, i / 10.0);
        const double mu = 0.2 + 0.1 * std::sin(std::log(v)) * std::sin(std::log(v));
        rows += fmt::format("t{:02},{:.6g},{:.6g},{:.8g}\n", t, scale * (400 + 100 * (t % 4)), v,
                            mu * gain * (1 + noise * random.normal()));
      }
    }
    directory.write("d.csv", rows);
    directory.write("job.toml", "[data]\ntraining = \"d.csv\"\n[data.columns]\nexperiment = "
                                "\"test\"\nsigma_n_MPa = \"p_MPa\"\nv_rel_mm_s = \"v_mm_s\"\n"
                                "tau_R_MPa = { column = \"mu\", times = \"sigma_n_MPa\" }\n" +
                                    sections);
  }
  CommandResult frictab(const std::vector<std::string>& arguments) const {
    return test::run_frictab(arguments, directory.path());
  }
  nlohmann::ordered_json json(const std::string& file) const {
    return test::parse_json(directory.read("out/" + file));
  }
  const TemporaryDirectory directory;
  const std::string laws =
      "[models]\nuse = [\"coulomb\", \"polynomial\"]\n[export]\ntargets = [\"c\"]\n";
};

TEST_F(Tolerance, IsATwentiethOfTheLawsErrorOnUnseenTestsWhateverTheUnitOfStress) {
  for (const double scale : {0.1, 1e-5}) {
    write_campaign(scale, laws + "[table]\nmodel = \"polynomial\"\n");
    const CommandResult run = frictab({"run", "job.toml"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto calibration = json("calibration.json");
    const auto fit = std::find_if(calibration.at("models").begin(), calibration.at("models").end(),
                                  [](const auto& one) { return one.at("name") == "polynomial"; });
    ASSERT_NE(fit, calibration.at("models").end());
    const double error = fit->at("validation").at("mae_MPa");
    const auto record = json("verify.json").at("records").at(0);
    EXPECT_DOUBLE_EQ(record.at("allowed_MPa"), std::min(0.5, error / 20));
    EXPECT_DOUBLE_EQ(record.at("law_error_MPa"), error);
    EXPECT_LE(record.at("worst_case_MPa").get<double>(), error / 20);
    EXPECT_EQ(record.at("passed"), true);
    const std::string from =
        fmt::format("a twentieth of the law's error on unseen tests, {:.3g} MPa", error);
    EXPECT_THAT(run.out, HasSubstr(fmt::format("  allowed, polynomial: {:.3g} MPa, ", error / 20) +
                                   from + "\n"));
    EXPECT_THAT(run.out, HasSubstr(fmt::format("; allowed: {:.3g}. ", error / 20)));
    EXPECT_THAT(directory.read("out/report.md"), HasSubstr(from));
    EXPECT_THAT(directory.read("out/report.html"),
                HasSubstr(fmt::format("{:.3g} MPa", error / 20)));
    const CommandResult info = frictab({"table", "info", "out/tables/polynomial.h5"});
    EXPECT_THAT(info.out, HasSubstr(fmt::format("Tolerance: {:.4g} MPa, ", error / 20) + from));
    const CommandResult alone = frictab(
        {"verify", "--table", "out/tables/polynomial.h5", "--model", "out/models/polynomial.json"});
    EXPECT_EQ(alone.exit_code, 0) << alone.out;
    EXPECT_THAT(alone.out, HasSubstr(from)) << "the table remembers";
  }
}

// A number is the owner's, and 0.5 MPa passes any table of stresses of 0.001 MPa: it is not "ok".
TEST_F(Tolerance, ThatIsGivenAndMoreThanTheLawErrsIsNeverOk) {
  write_campaign(1e-5, laws + "[table]\nmodel = \"polynomial\"\ntolerance_MPa = 0.5\n");
  const CommandResult run = frictab({"run", "job.toml"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, ContainsRegex("\n  polynomial .*DRIFTS MORE THAN THE LAW ERRS\n"));
  EXPECT_THAT(run.out, HasSubstr("table.tolerance_MPa = \"auto\" is a twentieth of that"));
  EXPECT_THAT(run.out, Not(ContainsRegex("\n  polynomial [^\n]* ok\n")));
  EXPECT_EQ(json("verify.json").at("records").at(0).at("over_law_error"), true);
  EXPECT_THAT(directory.read("out/report.md"), HasSubstr("**DRIFTS MORE THAN THE LAW ERRS**"));
  EXPECT_THAT(directory.read("out/report.html"), HasSubstr("DRIFTS MORE THAN THE LAW ERRS</span>"));
}

TEST_F(Tolerance, ThatIsNotMetIsAMiss) {
  write_campaign(1e-5, laws + "[table]\nmodel = \"polynomial\"\n[table.axes.v_rel_mm_s]\nnodes = "
                              "3\n[table.axes.sigma_n_MPa]\nnodes = 3\n");
  const CommandResult run = frictab({"run", "job.toml"});
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_THAT(run.out + run.err, ContainsRegex("the table of polynomial drifts by up to [0-9.e-]+ "
                                               "MPa, more than the [0-9.e-]+ MPa allowed \\(a "
                                               "twentieth of the law's error on unseen tests"));
}

TEST_F(Tolerance, OfEachLawIsItsOwn) {
  write_campaign(0.1, laws + "[table]\nmodel = \"all\"\n");
  const CommandResult run = frictab({"run", "job.toml"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto verify = json("verify.json"), calibration = json("calibration.json");
  double largest = 0;
  for (const auto& fit : calibration.at("models"))
    for (const auto& record : verify.at("records"))
      if (record.at("model") == fit.at("name")) {
        const double allowed = std::min(0.5, fit.at("validation").at("mae_MPa").get<double>() / 20);
        EXPECT_DOUBLE_EQ(record.at("allowed_MPa"), allowed);
        largest = std::max(largest, allowed);
      }
  EXPECT_DOUBLE_EQ(verify.at("max_drift_MPa"), largest);
  EXPECT_THAT(run.out, ContainsRegex("; allowed: [0-9.]+ to [0-9.]+\\. "));
}

// Numbers made by a formula are fitted without error, and no table is made to nothing.
TEST_F(Tolerance, IsNotBelowATenThousandthOfTheStress) {
  write_campaign(1, laws + "[table]\nmodel = \"coulomb\"\n", 0);
  std::string rows = "test,p_MPa,v_mm_s,mu\n";
  for (int t = 0; t < 6; ++t)
    for (int i = 0; i < 5; ++i)
      rows += fmt::format("t{},{},{},0.1\n", t, 500 + 100 * t, 1 + i);
  directory.write("d.csv", rows);
  const CommandResult run = frictab({"run", "job.toml", "--set", "models.use=[\"coulomb\"]"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("  allowed, coulomb: 0.0075 MPa, a ten-thousandth of the mean "
                                 "measured stress, 75 MPa;"));
}

// Significant digits in the columns, whatever the unit of stress.
TEST_F(Tolerance, StressesAreShownWithThreeDigits) {
  write_campaign(1e-5, laws + "[table]\nmodel = \"polynomial\"\n");
  const CommandResult run = frictab({"calibrate", "job.toml"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out,
              ContainsRegex("\n +[0-9]  polynomial +0\\.000[1-9][0-9][0-9]  0\\.000[0-9]+ to "
                            "0\\.000[0-9]+ +0\\.000[0-9]+ "));
  EXPECT_THAT(directory.read("out/benchmark.md"),
              ContainsRegex("polynomial \\| 0\\.000[1-9][0-9][0-9] \\|"));
}

TEST_F(Tolerance, TakesAutoAndANumber) {
  write_campaign(1, "");
  EXPECT_EQ(frictab({"data", "job.toml", "--set", "table.tolerance_MPa=\"auto\""}).exit_code, 0);
  const CommandResult wrong =
      frictab({"data", "job.toml", "--set", "table.tolerance_MPa=\"fine\""});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("table.tolerance_MPa must be \"auto\" or a number > 0"));
  EXPECT_THAT(frictab({"explain", "table.tolerance_MPa"}).out,
              HasSubstr("0.5 or a twentieth of the law's mean absolute error"));
}

// No test judges constants from elsewhere: their own stress is all there is to go by.
TEST_F(Tolerance, OfALawWithoutTestsIsAHundredthOfItsMeanStress) {
  const std::vector<std::string> law = {"export",
                                        "--law",
                                        "exp_coulomb",
                                        "--param",
                                        "mu0=0.1",
                                        "--param",
                                        "a=-0.3",
                                        "--param",
                                        "b=0.001",
                                        "--targets",
                                        "c",
                                        "--range",
                                        "T_contact_C=20..200"};
  auto low = law;
  low.insert(low.end(), {"--range", "sigma_n_MPa=0.001..0.01", "-o", "low"});
  const CommandResult small = frictab(low);
  ASSERT_EQ(small.exit_code, 0) << small.err << small.out;
  EXPECT_THAT(small.out, ContainsRegex("  allowed, exp_coulomb: [0-9.e-]+ MPa, a hundredth of the "
                                       "law's mean stress over its ranges, "));
  auto usual = law;
  usual.insert(usual.end(), {"-o", "usual"});
  const CommandResult large = frictab(usual);
  ASSERT_EQ(large.exit_code, 0) << large.err;
  EXPECT_THAT(large.out, HasSubstr("; allowed: 0.5. "));
}

TEST(AutoTolerance, IsTheSmallerOfHalfAMPaAndATwentiethOfTheError) {
  EXPECT_DOUBLE_EQ(table::auto_tolerance(8.4, 130, "unseen tests").MPa, 0.42);
  EXPECT_EQ(table::auto_tolerance(8.4, 130, "unseen tests").from,
            "a twentieth of the law's error on unseen tests, 8.4 MPa");
  EXPECT_EQ(table::auto_tolerance(14, 130, "unseen tests").MPa, 0.5);
  EXPECT_EQ(table::auto_tolerance(14, 130, "unseen tests").from,
            "less than a twentieth of the law's error on unseen tests, 14 MPa");
  EXPECT_DOUBLE_EQ(table::auto_tolerance(2e-5, 0.004, "unseen tests").MPa, 1e-6);
  EXPECT_DOUBLE_EQ(table::auto_tolerance(1e-12, 100, "unseen tests").MPa, 0.01);
  EXPECT_EQ(table::auto_tolerance(NAN, 100, "unseen tests").MPa, 0.5);
  EXPECT_EQ(table::least_error(2, 100), 2);
  EXPECT_DOUBLE_EQ(table::least_error(1e-12, 100), 0.01);
}

} // namespace
} // namespace frictab::auto_tolerance_test
