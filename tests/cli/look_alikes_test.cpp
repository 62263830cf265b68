// Look-alikes of public campaigns of measured friction, with the mistakes of the real files: each
// is read by a job file alone.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/encoding.h"
#include "support/json.h"
#include "support/run_command.h"

namespace frictab::look_alikes_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using test::utf16;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

// Scatter of a rig, without a random number: -1 to 1.
double scatter(int i) {
  return std::sin(12.9898 * i + 78.233);
}

std::string with_comma(double value, int digits) {
  std::string text = fmt::format("{:.{}f}", value, digits);
  if (const auto point = text.find('.'); point != text.npos) text[point] = ',';
  return text;
}

class LookAlike : public testing::Test {
protected:
  // What "frictab data" tells of the job.
  nlohmann::json read(const std::string& job) {
    directory.write("job.toml", job);
    const CommandResult text = run_frictab({"data", "job.toml", "-q"}, directory.path());
    said = text.out;
    const CommandResult result =
        run_frictab({"data", "job.toml", "--json", "-q", "--write"}, directory.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.exit_code == 0 ? nlohmann::json::parse(result.out) : nlohmann::json::object();
  }

  void calibrate() const {
    const CommandResult result = run_frictab(
        {"calibrate", "job.toml", "-q", "--set", "models.use=[\"coulomb\"]"}, directory.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }

  static const nlohmann::json& test_of(const nlohmann::json& data, const std::string& name) {
    for (const auto& test : data["tests"])
      if (test["experiment"] == name) return test;
    throw std::runtime_error("no test '" + name + "' in " + data["tests"].dump());
  }
  static std::vector<double> span(const nlohmann::json& test, const std::string& column) {
    return test["spans"][column].get<std::vector<double>>();
  }
  static int rows_of(const nlohmann::json& data) {
    int rows = 0;
    for (const auto& test : data["tests"])
      rows += test["rows"].get<int>();
    return rows;
  }

  TemporaryDirectory directory;
  std::string said; // by frictab data
};

// ---- pin on disc ----

// Steps 1 to 4 of one file are tests of their own; in every file they are called so.
std::string pin_on_disc_file(int preamble, bool speed_first, double level) {
  std::string text = preamble == 2 ? "Tribometer;V 2.1\rOperator;N;N\r\n" : "Tribometer;V 2.1\n";
  text += speed_first ? "Speed [rpm];Time [s];Step;COF\r\n" : "Time [s];Step;Speed [rpm];COF\r\n";
  const char* const ends[] = {"\r", "\n", "\r\n"};
  for (int step = 1; step <= 4; ++step)
    for (int i = 0; i < 300; ++i) {
      const double mu = level + 0.02 * step + 0.1 * std::exp(-i / 60.0) + 0.01 * scatter(i + step);
      const std::string time = fmt::format("{:.1f}", 0.5 * i), speed = fmt::to_string(30 * step);
      text += speed_first ? fmt::format("{};{};{};{:.4f}", speed, time, step, mu)
                          : fmt::format("{};{};{};{:.4f}", time, step, speed, mu);
      text += ends[(i + step) % 3];
    }
  return text;
}

TEST_F(LookAlike, PinOnDiscWithStepsInFilesAndItsConditionsInNamesAndAnotherFile) {
  std::string loads = "experiment;F_N [N]\n";
  int number = 0;
  for (const char* steel : {"316SS", "52100"})
    for (const int radius : {10, 20}) {
      const std::string name = fmt::format("{}_{}mm_run1", steel, radius);
      directory.write("rig/" + name + ".csv",
                      pin_on_disc_file(1 + number % 2, number == 2, 0.2 + 0.03 * number));
      ++number;
      for (int step = 1; step <= 4; ++step)
        loads += fmt::format("{} {};{}\n", name, step, 5 * step);
    }
  directory.write("loads.csv", loads);
  const auto data = read(R"([data]
training = "rig/*.csv"
experiment = "file+Step"
tests = "loads.csv"
[data.columns]
time_s = "Time"
F_N_N = "F_N"
sigma_n_MPa = { formula = "F_N_N/0.8" }
tau_R_MPa = { column = "COF", times = "sigma_n_MPa" }
v_rel_mm_s = { formula = "Speed*2*pi/60*radius_mm" }
[[data.files]]
match = "*"
from_name = '(?<steel>[^/_]+)_(?<radius_mm>\d+)mm'
)");
  ASSERT_EQ(data["tests"].size(), 16u);
  EXPECT_EQ(rows_of(data), 16 * 300);
  const auto& test = test_of(data, "52100_10mm_run1 3"); // of the file with two lines in front
  EXPECT_NEAR(span(test, "v_rel_mm_s")[0], 90 * 2 * M_PI / 60 * 10, 1e-9);
  EXPECT_THAT(span(test, "sigma_n_MPa"), ElementsAre(18.75, 18.75));
  EXPECT_THAT(span(test, "time_s"), ElementsAre(0, 149.5));
  EXPECT_THAT(
      said, HasSubstr("  Speed [rpm]  state  v_rel_mm_s is computed from it\n  radius_mm    state  "
                      "v_rel_mm_s is computed from it\n  steel        label  2 levels\n"));
  calibrate();
}

// ---- a reciprocating rig ----

TEST_F(LookAlike, ReciprocatingRigWithAColumnPerTestAndConditionsInItsName) {
  std::vector<std::string> names;
  for (const int additive : {0, 1, 10, 20})
    for (const int speed : {20, 50})
      for (const char chip : {'a', 'b', 'c'})
        names.push_back(fmt::format("OA{}_{}mm/s_chip {} ", additive, speed, chip));
  std::string text = "sep=,\nCycle";
  for (const std::string& name : names)
    text += "," + name;
  text += "\n";
  constexpr int cycles = 500;
  for (int i = 1; i <= cycles; ++i) {
    text += fmt::to_string(i);
    for (std::size_t t = 0; t < names.size(); ++t) {
      const bool ended = t == 4 && i > 321; // this test was stopped
      const double force = (0.9 + 0.01 * double(t)) * (1 - 0.12 * i / cycles);
      text += ended ? "," : fmt::format(",{:.4f}", force + 0.01 * scatter(i + 7 * int(t)));
    }
    text += "\n";
  }
  directory.write("all.csv", text);
  const auto data = read(R"([data]
training = "all.csv"
[data.wide]
columns = 'OA(?<additive_pct>\d+)_(?<v_rel_mm_s>\d+)mm/s_chip (?<chip>\w)'
[data.columns]
F_R_N = "value"
[data.constants]
F_N_N = 8
sigma_n_MPa = 40
)");
  ASSERT_EQ(data["tests"].size(), 24u);
  EXPECT_EQ(rows_of(data), 24 * cycles - (cycles - 321));
  const auto& test = test_of(data, "OA0_50mm/s_chip b");
  EXPECT_EQ(test["rows"], 321);
  EXPECT_THAT(span(test, "v_rel_mm_s"), ElementsAre(50, 50));
  EXPECT_NEAR(test["mean_mu"].get<double>(), (0.94 * (1 - 0.06 * 321 / cycles)) / 8, 1e-3);
  EXPECT_THAT(
      said,
      HasSubstr("  Cycle         channel  varies within tests, measured along with friction\n  "
                "additive_pct "
                " setting  one value per test, 4 of them\n  chip          label    3 levels\n"));
  calibrate();
}

// ---- composites ----

TEST_F(LookAlike, CompositesWithAFolderPerFillerAndADelimiterTooManyInEachRow) {
  int tests = 0;
  for (const char* filler : {"0 wt%", "2,5 wt%", "5 wt%", "7,5 wt%"})
    for (int repeat = 1; repeat <= 3; ++repeat, ++tests) {
      std::string text = "TIME; FF;\r\n";
      for (int i = 1; i <= 400; ++i)
        text += fmt::format(
            "{}; {};;\r\n", with_comma(0.9 * i, 1),
            with_comma(5 + 0.2 * repeat - std::exp(-i / 80.) + 0.2 * scatter(400 * tests + i), 1));
      directory.write(fmt::format("Composites/{}/test {}.csv", filler, repeat), text);
    }
  const auto data = read(R"([data]
training = "Composites/*/*.csv"
decimal = ","
[data.columns]
time_s = "TIME"
F_R_N = "FF"
[data.constants]
F_N_N = 20
sigma_n_MPa = 0.25
v_rel_mm_s = 1000
[[data.files]]
match = "*"
from_name = '/(?<filler_pct>[\d,]+) wt%/'
)");
  ASSERT_EQ(data["tests"].size(), 12u);
  EXPECT_EQ(rows_of(data), 12 * 400);
  const auto& test = test_of(data, "2,5 wt%/test 1");
  EXPECT_THAT(span(test, "time_s"), ElementsAre(0.9, 360));
  EXPECT_NEAR(span(test, "tau_R_MPa")[0], 0.25 / 20 * 4.2, 0.25 / 20 * 0.25);
  EXPECT_THAT(said, HasSubstr("filler_pct (4: 0, 2,5, 5, 7,5)"));
  calibrate();
}

// ---- a design of experiments ----

TEST_F(LookAlike, DesignOfExperimentsWithOneRowPerTestAndAnEmptyThirdLine) {
  std::string text = "Wear and friction of composites,,,,,,\n"
                     "Exp. No.,Load (N),Speed (m/s),Distance (m),Filler (wt%),COF,Wear (mm3)\n"
                     ",,,,,,\n";
  for (int i = 0; i < 27; ++i)
    text += fmt::format("{},{},{},{},{},{:.3f},{:.2f}\n", i + 1, 10 * (1 + i % 3),
                        0.5 * (1 + i / 3 % 3), 500 * (1 + i / 9), 2.5 * (i % 4),
                        0.3 + 0.05 * (i % 3) + 0.01 * scatter(i), 1 + 0.1 * i);
  directory.write("L27.csv", text);
  const auto data = read(R"([data]
training = "L27.csv"
experiment = "Exp. No."
[data.columns]
F_N_N = "Load"
sigma_n_MPa = { column = "Load", area_mm2 = 50 }
v_rel_mm_s = "Speed"
s_mm = "Distance"
tau_R_MPa = { column = "COF", times = "sigma_n_MPa" }
)");
  ASSERT_EQ(data["tests"].size(), 27u);
  EXPECT_EQ(rows_of(data), 27);
  const auto& test = test_of(data, "27");
  EXPECT_THAT(span(test, "s_mm"), ElementsAre(1.5e6, 1.5e6));
  EXPECT_THAT(span(test, "v_rel_mm_s"), ElementsAre(1500, 1500));
  EXPECT_NEAR(span(test, "sigma_n_MPa")[0], 0.6, 1e-12);
  calibrate();
  const CommandResult traced = run_frictab(
      {"trace", "job.toml", "-q", "--set", "models.use=[\"coulomb\"]"}, directory.path());
  EXPECT_EQ(traced.exit_code, 0) << traced.err;
  EXPECT_THAT(traced.out, HasSubstr("+ sigma_n_MPa: exponential, on mu"))
      << "of three loads, or a line";
  EXPECT_THAT(traced.out, HasSubstr("over all that was tried"));
}

// ---- a powder shear cell ----

// Two powders, each sheared under three stresses; what stands in front of an interval is no row.
std::string shear_cell_file(int powder) {
  std::string text = fmt::format("Project:\tpowder {}\r\nDate:\t3/4/2021\r\n\r\n", powder);
  for (int interval = 1; interval <= 3; ++interval) {
    const int points = 20 * interval;
    text += fmt::format("Interval:\t{}\t{} data points\r\n\r\n"
                        "Point No.\tTime\tNormal Stress\tShear Stress\tStatus\t\r\n\r\n"
                        "\t[s]\t[Pa]\t[Pa]\t[1]\t\r\n",
                        interval, points);
    for (int i = 1; i <= points; ++i) {
      const double sigma = 3000 * interval + 5 * scatter(i);
      const double tau = (0.5 + 0.1 * powder) * sigma * (1 - 0.5 * std::exp(-i / 8.));
      text += fmt::format("{}\t{}\t{:.2f}\t{:.2f}\tM-\t\r\n", i, 0.5 * i, sigma, tau);
    }
    text += "\r\n";
  }
  return text;
}

TEST_F(LookAlike, PowderShearCellInUtf16WithItsHeaderBeforeEachInterval) {
  for (const int powder : {1, 2})
    directory.write(fmt::format("cell/powder {}.txt", powder), utf16(shear_cell_file(powder)));
  const auto data = read(R"([data]
training = "cell"
units_row = true
experiment = "interval"
[data.columns]
time_s = "Time"
sigma_n_MPa = "Normal Stress"
tau_R_MPa = "Shear Stress"
[[data.files]]
match = "*"
from_name = '(?<powder>powder \d)'
)");
  ASSERT_EQ(data["tests"].size(), 6u);
  EXPECT_EQ(rows_of(data), 2 * (20 + 40 + 60));
  const auto& test = test_of(data, "powder 2 3");
  EXPECT_EQ(test["rows"], 60);
  EXPECT_NEAR(span(test, "sigma_n_MPa")[1], 0.009005, 1e-6);
  EXPECT_THAT(span(test, "time_s"), ElementsAre(0.5, 30));
  EXPECT_THAT(said, HasSubstr("sigma_n_MPa: Pa in the file, converted to MPa"));
  calibrate();
}

// ---- velocity steps ----

// Slip at two speeds in turn, with a transient of rate and state after each step.
std::string velocity_steps(int rows, double mu) {
  std::string text = "Time[s]  ShearStress[MPa]  NormStress[MPa]  LPdisp\n";
  double slip = 0, state = 0;
  for (int i = 0; i < rows; ++i) {
    const double v = i / 2000 % 2 ? 10 : 1; // um/s
    const double dt = 0.1, before = state;
    slip += v * dt;
    state += (std::log(v) - state) * (1 - std::exp(-v * dt / 20));
    const double tau = 25 * (mu + 0.008 * std::log(v) - 0.012 * before + 1e-4 * scatter(i));
    text += fmt::format("  {:.1f}  {:.5f}  {:.4f}  {:.3f}\n", dt * i, tau,
                        25 + 0.01 * scatter(3 * i), slip);
  }
  return text;
}

TEST_F(LookAlike, VelocityStepsOnRockInLongExperiments) {
  directory.write("p4.txt", velocity_steps(20000, 0.6));
  directory.write("p5.txt", velocity_steps(12000, 0.62));
  const auto data = read(R"([data]
training = "p4.txt"
validation = "p5.txt"
[data.columns]
time_s = "Time"
tau_R_MPa = "ShearStress"
sigma_n_MPa = "NormStress"
s_mm = { column = "LPdisp", unit = "um" }
v_rel_mm_s = { column = "LPdisp", unit = "um", slope_rows = 21 }
)");
  ASSERT_EQ(data["tests"].size(), 2u);
  EXPECT_EQ(rows_of(data), 32000);
  const auto& test = test_of(data, "p4");
  EXPECT_THAT(span(test, "v_rel_mm_s"),
              ElementsAre(DoubleNear(0.001, 1e-6), DoubleNear(0.01, 1e-6)));
  EXPECT_NEAR(span(test, "s_mm")[1], 11, 1e-6);
  EXPECT_NEAR(test["mean_mu"].get<double>(), 0.595, 0.01);
}

} // namespace
} // namespace frictab::look_alikes_test
