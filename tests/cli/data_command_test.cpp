// "frictab data": what was read, test by test, before a law is fitted to it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"

namespace frictab::data_command_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;

class DataCommand : public testing::Test {
protected:
  // A rig's file and its simulation, a second late; the rig writes kN and a speed in rpm.
  void write_campaign() {
    for (int test = 1; test <= 3; ++test) {
      std::string rig = "Zeit [s];Normalkraft [kN];Reibkraft [N];rpm\n", fe = "time_s,F_N_N,p\n";
      for (int i = 0; i <= 40; ++i) {
        const double t = 0.1 * i, force = 1000 + 500 * t * t;
        rig += fmt::format("{};{};{};{}\n", t, force / 1000, 0.1 * test * force, 60);
        fe += fmt::format("{},{},{}\n", t + 1, force, 100 + 10 * t);
      }
      directory.write(fmt::format("rig/K{}.csv", test), rig);
      directory.write(fmt::format("fe/K{}.csv", test), fe);
    }
    directory.write("tests.csv", "experiment,batch\nK1,a\nK2,a\nK3,b\nK4,b\n");
    directory.write("job.toml", R"([data]
training = ["rig/K1.csv", "rig/K2.csv"]
validation = "rig/K3.csv"
tests = "tests.csv"
[data.columns]
time_s = "Zeit"
F_N_N = "Normalkraft"
F_R_N = "Reibkraft"
v_rel_mm_s = { formula = "rpm*2*pi*5/60" }
[data.join]
files = "fe"
columns = { sigma_n_MPa = "p" }
offset = -1
)");
  }

  TemporaryDirectory directory;
};

TEST_F(DataCommand, ShowsEachTestAndWhatWasDoneToIt) {
  write_campaign();
  const CommandResult result = run_frictab({"data", "job.toml"}, directory.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "wrote data.html to out\n");
  EXPECT_EQ(result.out, "Tests:\n"
                        "  test  use       rows  mean mu  mean tau_R/k  time_s  sigma_n_MPa  "
                        "v_rel_mm_s      s_mm  tau_R_MPa\n"
                        "  K1    train       41    0.100             -  0 to 4   100 to 140        "
                        "31.4  0 to 126   10 to 14\n"
                        "  K2    train       41    0.200             -  0 to 4   100 to 140        "
                        "31.4  0 to 126   20 to 28\n"
                        "  K3    validate    41    0.300             -  0 to 4   100 to 140        "
                        "31.4  0 to 126   30 to 42\n"
                        "\n"
                        "Other columns:\n"
                        "  column  role   why\n"
                        "  rpm     state  v_rel_mm_s is computed from it\n"
                        "  batch   label  2 levels\n"
                        "\n"
                        "Files:\n"
                        "  file                           form              names in line  units "
                        "in line  rows  not read\n"
                        "  rig/K1.csv (and 2 more files)  text, cells by ;              1        "
                        "      -   123  -\n"
                        "\n"
                        "Data:\n"
                        "  82 rows of 2 experiments to train, 41 rows of 1 experiment to validate\n"
                        "  files: rig/K1.csv and rig/K2.csv\n"
                        "  files: rig/K3.csv\n"
                        "  read: F_N_N: kN in the file, converted to N\n"
                        "  read: tests.csv: batch, by test\n"
                        "  read: joined by time_s: sigma_n_MPa\n"
                        "  read: of data.join not taken, the rows have their own: F_N_N\n"
                        "  read: v_rel_mm_s = rpm*2*pi*5/60\n"
                        "  read: tau_R_MPa = F_R_N/F_N_N * sigma_n_MPa (eq. 1)\n"
                        "  read: s_mm integrated from v_rel_mm_s and time_s\n"
                        "  unit not given: no unit is given for 'p', taken as MPa: sigma_n_MPa is "
                        "121; in kPa 0.121, in kgf/mm2 1,190, in bar 12.1. Say which one where it "
                        "is mapped: sigma_n_MPa = { column = \"p\", unit = \"MPa\", ... }\n"
                        "  in none of the data: tests.csv: K4\n");
  const std::string page = directory.read("out/data.html");
  for (const char* text : {"test K1", "test K3", "F_N_N: kN in the file", "tests.csv: K4"})
    EXPECT_THAT(page, HasSubstr(text));
}

TEST_F(DataCommand, FindsTheOffsetOfTheSimulationsClock) {
  write_campaign();
  const CommandResult result = run_frictab(
      {"data", "job.toml", "--json", "--set", "data.join.offset=\"auto\""}, directory.path());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto clocks = nlohmann::json::parse(result.out)["clocks"];
  ASSERT_EQ(clocks.size(), 3);
  for (const auto& clock : clocks)
    EXPECT_NEAR(clock["offset"].get<double>(), -1, 1e-3) << clock;
}

TEST_F(DataCommand, WritesTheDataInCanonicalNamesThatReadBackTheSame) {
  write_campaign();
  ASSERT_EQ(run_frictab({"data", "job.toml", "--write", "-q"}, directory.path()).exit_code, 0);
  const std::string csv = directory.read("out/data.csv");
  EXPECT_THAT(csv, testing::StartsWith("experiment,time_s,F_R_N,F_N_N,rpm,batch,sigma_n_MPa,"
                                       "v_rel_mm_s,tau_R_MPa,s_mm,use\nK1,0,100,1000,60,a,100,"));
  directory.write("out/job.toml", "[data]\ntraining = \"data.csv\"\n");
  const CommandResult again =
      run_frictab({"data", "job.toml", "--write", "hdf5", "-q"}, directory.path("out"));
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("    0.100             -  0 to 4   100 to 140        31.4"));
  directory.write("out/job.toml", "[data]\ntraining = \"out/data.h5\"\n");
  const CommandResult hdf5 = run_frictab({"data", "job.toml", "-q"}, directory.path("out"));
  EXPECT_EQ(hdf5.exit_code, 0) << hdf5.err;
  EXPECT_THAT(hdf5.out, HasSubstr("    0.100             -  0 to 4   100 to 140        31.4"));
}

TEST_F(DataCommand, ShowsImplausibleDataAndFails) {
  directory.write("a.csv", "experiment,sigma_n_MPa,tau_R_MPa\n1,1e8,1e7\n1,2e8,2e7\n"
                           "2,1e8,1e7\n2,2e8,2e7\n");
  directory.write("job.toml", "[data]\ntraining = \"a.csv\"\n");
  const CommandResult result = run_frictab({"data", "job.toml"}, directory.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("job.toml:2:12: error: sigma_n_MPa is"));
  EXPECT_THAT(
      result.out,
      HasSubstr("4 rows of 2 experiments, each experiment judged by laws fitted without it"));
  EXPECT_THAT(directory.read("out/data.html"),
              HasSubstr("<strong>No rig measures this:</strong> sigma_n_MPa is"));
}

} // namespace
} // namespace frictab::data_command_test
