// Two choices of [export.inputs] that a routine follows by a state variable: the surface expansion
// as area over area at the first contact, and the sliding speed smoothed over increments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "support/calls/usrfrc.h"
#include "support/calls/vfric.h"
#include "support/calls/vfriction.h"
#include "support/generated.h"
#include "support/sample_tables.h"
#include "table/interpolation.h"

namespace frictab::area_and_speed_test {

using codegen::ExportRequest;
using codegen::find_exporter;
using codegen::Library;

namespace {

const std::map<std::string, std::string> choices = {{"psi", "area_ratio"},
                                                    {"v_rel_mm_s", "smoothed:4"},
                                                    {"sigma_f_MPa", "constant:480"},
                                                    {"T_contact_C", "constant:90"}};

struct Increment {
  double pressure, speed, area; // MPa, mm/s, mm^2
};
// First out of contact; then stretched, open for an increment, shrunk below its first area.
const std::vector<Increment> path = {{0, 50, 1},    {600, 40, 2},    {900, 200, 3},
                                     {1200, 20, 6}, {0, 300, 30},    {800, 90, 9},
                                     {1500, 0, 12}, {1500, 300, 14}, {2000, 60, 1.5}};
constexpr double time_increment = 0x1p-10;

// The definition.
std::vector<double> expected() {
  const table::Table table = test::four_axis_table();
  const table::TableFunction law(table);
  double first = 0, late = 0;
  std::vector<double> tau;
  for (const Increment& now : path) {
    const double psi = first > 0 ? now.area / first : 1;
    const double speed = late > 0 ? late + (now.speed - late) / 4 : now.speed;
    const std::map<std::string, double> state = {{"sigma_n_MPa", now.pressure},
                                                 {"psi", psi},
                                                 {"v_rel_mm_s", speed},
                                                 {"T_contact_C", 90},
                                                 {"sigma_f_MPa", 480}};
    std::vector<double> x;
    for (const std::string& name : table.inputs())
      x.push_back(state.at(name));
    tau.push_back(now.pressure > 0 ? law(x) : 0);
    if (now.pressure > 0) late = speed;
    if (now.pressure > 0 && first == 0) first = now.area;
  }
  return tau;
}

void* function(const std::string& target, const std::string& entry, const std::string& variant) {
  const table::Table table = test::four_axis_table();
  return Library::address(test::compiled("area_and_speed", *find_exporter(target),
                                         {table, "mm-t-s", choices}, variant, test::strict)
                              ->handle(),
                          entry);
}

template <class Call> std::vector<double> explicit_path(Call& c, void* routine) {
  std::vector<double> tau;
  c.time_increment = time_increment;
  c.states = 6 + 2 * 2;
  for (const Increment& now : path) {
    c.area[0] = now.area;
    c.normal[0] = now.pressure * now.area;
    c.slip[0] = now.speed * time_increment;
    c.run(routine);
    c.previous[0] = c.tangential[0];
    tau.push_back(-c.tangential[0] / now.area);
  }
  return tau;
}

class AreaAndSpeed : public test::NeedsGfortran {
protected:
  static void expect(const std::vector<double>& tau) {
    const std::vector<double> want = expected();
    for (std::size_t i = 0; i < path.size(); ++i)
      EXPECT_NEAR(tau[i], want[i], 1e-10) << "increment " << i;
  }
};

TEST_F(AreaAndSpeed, AreFollowedByVfric) {
  calls::VfricCall<double> c;
  c.states = 10;
  c.resize(1, 1);
  expect(explicit_path(c, function("abaqus_vfric", "vfric_", "double")));
}

TEST_F(AreaAndSpeed, AreFollowedByVfrictionAlsoAtEdges) {
  calls::VfrictionCall<double> c;
  c.states = 10;
  c.edges = true;
  c.resize(1);
  expect(explicit_path(c, function("abaqus_vfriction", "vfriction_", "double")));
}

TEST_F(AreaAndSpeed, AreFollowedByUsrfrc) {
  calls::UsrfrcCall<double, std::int64_t> c;
  c.histories = 6 + 2 * 2;
  c.rate = 1 / time_increment;
  c.resize(1);
  void* const routine = function("lsdyna_usrfrc", "usrfrc_", "double");
  std::vector<double> tau;
  for (const Increment& now : path) {
    c.area[0] = now.area;
    c.normal[0] = -now.pressure * now.area;
    c.slip[1][0] = now.speed * time_increment;
    c.force[0][0] = 0;
    c.before[2] = 0x1p60;
    c.before[3] = c.before[4] = 0;
    c.run(routine);
    tau.push_back(c.force[0][0] / now.area);
  }
  expect(tau);
}

TEST_F(AreaAndSpeed, DriveAsTheTableInBothPrecisions) {
  const table::Table table = test::four_axis_table();
  const std::map<std::string, double> fixed = {{"T_contact_C", 90}, {"sigma_f_MPa", 480}};
  for (const char* target : {"abaqus_vfric", "abaqus_vfriction", "lsdyna_usrfrc"})
    for (const auto& [variant, bound] : {std::pair{"double", 1e-12}, {"single", 2e-6}})
      EXPECT_LT(test::worst_driven(*find_exporter(target), {table, "mm-t-s", choices}, variant,
                                   test::strict, fixed),
                bound)
          << target << " " << variant;
}

std::string refusal(const std::string& target, const std::map<std::string, std::string>& inputs) {
  const table::Table table = test::four_axis_table();
  return test::refusal([&] { find_exporter(target)->generate({table, "mm-t-s", inputs}); });
}

TEST(AreaAndSpeedChoices, AreRefusedWhereTheSolverCannotFollowThem) {
  EXPECT_THAT(refusal("abaqus_fric", {{"psi", "area_ratio"}}),
              testing::HasSubstr("'area_ratio' is not a source of a state"));
  EXPECT_THAT(refusal("abaqus_fric", {{"v_rel_mm_s", "smoothed:4"}}),
              testing::HasSubstr("the solver gives this state itself"));
  EXPECT_THAT(refusal("abaqus_vfric_coef", {{"psi", "area_ratio"}}),
              testing::HasSubstr("'area_ratio' is not a source of a state"));
}

TEST(AreaAndSpeedChoices, SayWhichNumbersOfIncrementsThereAre) {
  for (const char* none : {"smoothed:1", "smoothed:x", "smoothed:", "smoothed:-3", "smoothed:1e9"})
    EXPECT_THAT(refusal("abaqus_vfric", {{"v_rel_mm_s", none}}),
                testing::HasSubstr("is not a number of increments from 2 to 100000"))
        << none;
  EXPECT_EQ(refusal("abaqus_vfric", {{"v_rel_mm_s", "smoothed:2"}}), "accepted");
}

} // namespace

} // namespace frictab::area_and_speed_test
