// A campaign that slides in several directions of a sheet, through the commands: the effect is
// found, and each routine takes the direction from its solver's slip. The data are synthetic.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/random.h"
#include "support/run_command.h"

namespace frictab::direction_command_test {
namespace {

using test::run_frictab;
using testing::HasSubstr;

// mu falls and rises by 30 % with the cosine of twice the angle from 30 degrees.
std::string campaign() {
  std::string text = "experiment,sigma_n_MPa,psi,v_rel_mm_s,T_contact_C,s_mm,sigma_f_MPa,time_s,"
                     "direction_deg,tau_R_MPa\n";
  Random random(3);
  for (int test = 0; test < 54; ++test) {
    const double angle = 22.5 * (test % 9), speed = test % 2 ? 100 : 20;
    const double scatter = random.uniform(0.98, 1.02);
    for (int row = 0; row < 15; ++row) {
      const double pressure = (test % 4 < 2 ? 200 : 500) * (1 - 0.02 * row), slip = row + 1;
      const double turn = 2 * (angle - 30) * std::numbers::pi / 180;
      const double tau = 0.12 * (1 + 0.3 * std::cos(turn)) * scatter * pressure;
      text +=
          fmt::format("t{},{},1,{},{},{},400,{},{},{}\n", test, pressure, speed, test % 3 ? 25 : 80,
                      slip, slip / speed, angle, tau * random.uniform(0.98, 1.02));
    }
  }
  return text;
}

TEST(LongDirectionCommand, RunShipsRoutinesThatTakeTheDirectionFromTheSlip) {
  const test::TemporaryDirectory directory;
  directory.write("training.csv", campaign());
  const std::string job = directory.write("job.toml", R"([data]
training = "training.csv"
[models]
use = ["coulomb"]
[calibration]
bootstrap = 50
[export]
targets = ["abaqus_vfric", "abaqus_fric", "abaqus_vfric_coef", "c"]
[export.abaqus_vfric.inputs]
direction_deg = "slip:0,1,0"
[verify]
samples = 2000
)");
  const auto result = run_frictab({"run", job});
  ASSERT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("+ direction_deg: cosine, on mu"));
  EXPECT_THAT(directory.read("out/export/abaqus_vfric/README.md"),
              HasSubstr("from the direction (0, 1, 0) of the model"));
  EXPECT_THAT(directory.read("out/export/abaqus_fric/README.md"),
              HasSubstr("from local direction 1 towards 2"));
  EXPECT_THAT(directory.read("out/export/abaqus_vfric_coef/README.md"),
              HasSubstr("for all slips: their direction is not given"));
  const auto verified = run_frictab({"verify", job, "-q"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
  const auto drift = nlohmann::json::parse(directory.read("out/verify.json"));
  ASSERT_GE(drift.at("records").size(), 4u);
  for (const auto& record : drift.at("records"))
    EXPECT_TRUE(record.at("passed")) << record.at("subject");
}

} // namespace
} // namespace frictab::direction_command_test
