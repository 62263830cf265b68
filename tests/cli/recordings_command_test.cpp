// What a job says of tests that are intervals of one recording, from reading to tracing.
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/json.h"
#include "support/run_command.h"

namespace frictab::recordings_command_test {
namespace {

using test::CommandResult;
using test::run_frictab;
using test::TemporaryDirectory;
using testing::HasSubstr;
using testing::Not;

double scatter(int i) {
  return std::sin(12.9898 * i + 78.233);
}

class RecordingsCommand : public testing::Test {
protected:
  std::string run(const std::vector<std::string>& words) {
    const CommandResult result = run_frictab(words, directory.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }
  nlohmann::json json(const std::string& file) {
    return nlohmann::json::parse(directory.read(file));
  }
  TemporaryDirectory directory;
};

// Sixteen strokes, there and back: 0.30 and 0.36, and a scatter of the stroke.
TEST_F(RecordingsCommand, TheNumberOfAnIntervalIsFoundAsACause) {
  for (int f = 1; f <= 16; ++f) {
    std::string text;
    for (int step = 1; step <= 2; ++step) {
      text += fmt::format("Step No. {}\n\nF,N,T\n", step);
      for (int k = 0; k < 30; ++k)
        text += fmt::format("{:.4f},{:.3f},{:.3f}\n",
                            10 * (step == 1 ? 0.3 : 0.36) *
                                (1 + 0.01 * scatter(f) + 0.01 * scatter(1000 * f + 40 * step + k)),
                            10 + 0.02 * scatter(7000 * f + 40 * step + k), 0.02 * k);
      text += "\n";
    }
    directory.write(fmt::format("stroke_{:02}.csv", f), text);
  }
  directory.write("job.toml", R"([data]
training = "stroke_*.csv"
experiment = "interval"
[data.columns]
time_s = "T"
F_N_N = "N"
F_R_N = "F"
sigma_n_MPa = { column = "N", area_mm2 = 1 }
[models]
use = ["coulomb"]
[output]
directory = "out"
)");
  const std::string told = run({"data", "job.toml", "-q"});
  EXPECT_THAT(told, HasSubstr("32 tests are intervals of 16 recordings (intervals of one file)"));
  EXPECT_THAT(told, HasSubstr("each of 16 recordings judged by laws fitted without it"));
  EXPECT_THAT(run({"trace", "job.toml", "-q"}), HasSubstr("+ interval"));
  const auto trace = json("out/trace.json");
  EXPECT_LT(trace.at("after").at("validation").at("mae_MPa").get<double>(), 0.1);
  EXPECT_GT(trace.at("before").at("validation").at("mae_MPa").get<double>(), 0.2);
  EXPECT_EQ(json("out/calibration.json").at("recordings"), 16);
}

// Numbers at the end of the file's name order the tests; the file itself does not.
TEST_F(RecordingsCommand, ACampaignSortedOtherwiseGivesTheSameFits) {
  const auto write = [&](const char* name, int first, int step) {
    std::string text = "experiment,sigma_n_MPa,v_rel_mm_s,tau_R_MPa\n";
    for (int i = 0; i < 36; ++i) {
      const int e = (first + step * i) % 36;
      for (int k = 0; k < 12; ++k) {
        const double sigma = 200 + 100 * (e % 6) + 5 * k, v = 5 * (1 + e / 6);
        text += fmt::format("t{},{},{},{:.6f}\n", e, sigma, v,
                            0.1 * sigma * std::pow(v, -0.1) *
                                (1 + 0.05 * scatter(e) + 0.01 * scatter(100 * e + k)));
      }
    }
    directory.write(std::string(name) + ".csv", text);
    directory.write(std::string(name) + ".toml",
                    fmt::format("[data]\ntraining = \"{0}.csv\"\n[models]\nuse = [\"coulomb\", "
                                "\"polynomial\"]\n[output]\ndirectory = \"{0}\"\n",
                                name));
    run({"calibrate", std::string(name) + ".toml", "-q"});
    return directory.read(std::string(name) + "/calibration.json");
  };
  const std::string sorted = write("sorted", 0, 1);
  EXPECT_THAT(sorted, HasSubstr("\"held_out\""));
  EXPECT_EQ(write("shuffled", 17, 5), sorted) << "to the last digit";
}

} // namespace
} // namespace frictab::recordings_command_test
