// FRIC called as Abaqus/Standard calls it, with bounds checked and floating point traps on: stress,
// tangents, histories and every trap of the interface that is known, by name.
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../../exporters/abaqus_fric/call.h"
#include "core/error.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab {

namespace {

using abaqus_fric::FricCall;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string> strict = {"-Wall",
                                         "-Wextra",
                                         "-Werror",
                                         "-Wno-unused-dummy-argument",
                                         "-Wno-unused-parameter",
                                         "-fcheck=all",
                                         "-g",
                                         "-ffpe-trap=invalid,zero,overflow"};

constexpr double psi = 2.5, flow = 480;
constexpr double critical = 0x1p-7; // mm, the elastic slip at which sticking ends
// The order of operations only.
constexpr double bound = 1e-13;

const Table& four_axis() {
  static const Table table = test::four_axis_table();
  return table;
}

class Fric : public testing::Test {
protected:
  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  }

  static void* routine(const std::string& key, const ExportRequest& request) {
    return Library::address(
        test::compiled(key, *find_exporter("abaqus_fric"), request, "double", strict)->handle(),
        "fric_");
  }
  static void* four_axes() { return routine("four_axes", {four_axis(), "mm-t-s", {}}); }
  static const Table& slipping() { // by speed and sliding distance
    static const Table table = test::branching_table();
    return table;
  }
  static void* branching() { return routine("branching", {slipping(), "mm-t-s", {}}); }

  // 1000 MPa, 100 degC, at rest; properties of the four-axis table.
  static FricCall call(int directions = 2) {
    FricCall c;
    c.directions = directions;
    c.pressure = 1000;
    c.temperature[0] = c.temperature[1] = 100;
    c.time_increment = 0x1p-10;
    c.properties = {psi, flow, critical};
    c.resize();
    return c;
  }
  static FricCall branching_call(int directions = 1) {
    FricCall c = call(directions);
    c.pressure = 300;
    c.properties = {flow, critical};
    return c;
  }
  // Motion at this speed; the angle from direction 1 in degrees.
  static void move(FricCall& c, double speed, double angle = 0) {
    const double motion = speed * c.time_increment, turn = angle * std::numbers::pi / 180;
    c.motion[0] = angle == 0 ? motion : motion * std::cos(turn);
    if (c.directions == 2) c.motion[1] = angle == 0 ? 0 : motion * std::sin(turn);
  }

  // Fills what the routine has to give with rubbish, and runs it.
  static void run(FricCall& c, void* function) {
    for (auto* out : {&c.by_motion, &c.by_pressure, &c.by_temperature, &c.slip})
      std::fill(out->begin(), out->end(), 777);
    c.elastic_energy = c.dissipation = 777;
    const test::FloatTraps traps;
    c.run(function);
  }

  static double tau(double pressure, double speed, double temperature) {
    static const TableFunction table(four_axis());
    const double state[] = {pressure, psi, speed, temperature, flow};
    return table(state);
  }
  static double slip_tau(double pressure, double speed, double slip) {
    static const TableFunction table(slipping());
    const double state[] = {pressure, speed, slip, flow};
    return table(state);
  }
  static double size(const std::vector<double>& a) {
    return a.size() == 1 ? std::abs(a[0]) : std::hypot(a[0], a[1]);
  }
};

#define EXPECT_CLOSE(a, b) EXPECT_NEAR(a, b, bound* std::abs(b))

TEST_F(Fric, GivesTheLimitAlongPositiveAndNegativeSlipInOneDirection) {
  for (const double speed : {50.0, -50.0}) {
    auto c = call(1);
    move(c, speed);
    run(c, four_axes());
    EXPECT_EQ(c.mode, 0);
    EXPECT_CLOSE(c.tau[0], std::copysign(tau(1000, 50, 100), speed)); // 50 mm/s: 0.0488 mm
    EXPECT_CLOSE(c.slip[0], std::copysign(50 * 0x1p-10 - critical, speed));
  }
}

TEST_F(Fric, GivesTheLimitAlongTheSlipInTwoDirections) {
  for (const double angle : {0.0, 30.0, 135.0, 250.0}) {
    auto c = call(2);
    move(c, 50, angle);
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100)) << angle;
    EXPECT_NEAR(c.tau[0] * c.motion[1] - c.tau[1] * c.motion[0], 0, 1e-13) << angle;
    EXPECT_GT(c.tau[0] * c.motion[0] + c.tau[1] * c.motion[1], 0) << angle;
  }
}

TEST_F(Fric, SticksElasticallyBelowTheCriticalSlip) {
  for (const int directions : {1, 2}) {
    auto c = call(directions);
    move(c, 2, directions == 1 ? 0 : 60); // 0.00195 mm; the table's slowest 5 mm/s
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 2, 100) * 2 * 0x1p-10 / critical);
    EXPECT_EQ(size(c.slip), 0);
    EXPECT_EQ(c.state[0], 0);
    EXPECT_EQ(c.dissipation, 0);
    EXPECT_CLOSE(c.elastic_energy, 0.5 * size(c.tau) * 2 * 0x1p-10);
  }
}

TEST_F(Fric, NeverExceedsTheLimitWhateverTheMotion) {
  auto c = call(2);
  for (int increment = 1; increment < 400; ++increment) {
    c.increment = increment;
    const double speed = 12.0 * (increment % 13);
    move(c, speed, 41.0 * increment);
    c.pressure = 300 + 37 * (increment % 60);
    run(c, four_axes());
    EXPECT_LE(size(c.tau), tau(c.pressure, speed, 100) * (1 + 1e-13)) << increment;
    EXPECT_GE(c.dissipation, 0);
    EXPECT_LE(std::hypot(c.state[4], c.state[5]), critical * (1 + 1e-15));
  }
}

TEST_F(Fric, TurnsRoundElasticallyWhenTheMotionReverses) {
  auto c = call(1);
  move(c, 50);
  run(c, four_axes());
  const double limit = tau(1000, 1, 100);
  c.increment = 2;
  move(c, -1);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], limit * (critical - 0x1p-10) / critical);
  EXPECT_EQ(c.slip[0], 0);
  c.increment = 3;
  move(c, -50);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], -tau(1000, 50, 100));
}

// Every derivative against the central difference of the routine itself.
void expect_tangents(const FricCall& start, void* function, const std::string& what) {
  SCOPED_TRACE(what);
  FricCall at = start;
  at.run(function);
  const auto n = static_cast<std::size_t>(start.directions);
  const auto compare = [&](auto&& number, double step, auto&& derivative, const char* name) {
    FricCall up = start, down = start;
    number(up) += step;
    number(down) -= step;
    up.run(function);
    down.run(function);
    for (std::size_t i = 0; i < n; ++i) {
      const double wanted = (up.tau[i] - down.tau[i]) / (2 * step);
      // Rounding of the difference, and what the third derivative leaves: both below 1e-6 of the
      // stress over the step at which it doubles.
      const double scale = std::max(std::abs(wanted), 1e-9 * std::abs(at.tau[i]) / step);
      EXPECT_NEAR(derivative(at, i), wanted, 2e-5 * scale) << name << " of " << i;
    }
  };
  for (std::size_t j = 0; j < n; ++j)
    compare([j](FricCall& c) -> double& { return c.motion[j]; }, 1e-8,
            [&, j](const FricCall& c, std::size_t i) { return c.by_motion[i + n * j]; },
            j == 0 ? "DDTDDG(,1)" : "DDTDDG(,2)");
  compare([](FricCall& c) -> double& { return c.pressure; }, 1e-5 * start.pressure,
          [](const FricCall& c, std::size_t i) { return c.by_pressure[i]; }, "DDTDDP");
  for (std::size_t side = 0; side < 2; ++side)
    compare([side](FricCall& c) -> double& { return c.temperature[side]; }, 1e-3,
            [&, side](const FricCall& c, std::size_t i) { return c.by_temperature[i + n * side]; },
            "DDTDDT");
}

TEST_F(Fric, TangentsOfSlipAndStickAreThoseOfItsOwnDifferences) {
  for (const int directions : {1, 2})
    for (const double speed : {0.5, 6.0, 9.0, 50.0, 300.0, 900.0}) { // 8 mm/s: the transition
      auto c = call(directions);
      move(c, speed, directions == 1 ? 0 : 35);
      expect_tangents(c, four_axes(), "from rest at " + std::to_string(speed));
      run(c, four_axes()); // and with a history of elastic slip
      c.increment = 2;
      move(c, speed, directions == 1 ? 0 : 80);
      expect_tangents(c, four_axes(), "turning at " + std::to_string(speed));
    }
}

TEST_F(Fric, TangentsHoldWhereTheLimitFollowsTheSlipItself) {
  for (const int directions : {1, 2})
    for (const double speed : {3.0, 12.0, 40.0}) {
      auto c = branching_call(directions);
      c.time_increment = 0.125;
      move(c, speed, directions == 1 ? 0 : 35);
      run(c, branching());
      c.increment = 2;
      move(c, speed, directions == 1 ? 0 : 80);
      expect_tangents(c, branching(), std::to_string(speed));
    }
}

TEST_F(Fric, TangentsHoldBelowTheSmallestPressureAndAtTheShearLimit) {
  for (const double pressure : {0.01, 0.7, 2200.0, 9000.0})
    for (const double speed : {3.0, 40.0}) {
      auto c = call(2);
      c.pressure = pressure;
      move(c, speed, 20);
      expect_tangents(c, four_axes(), std::to_string(pressure));
    }
}

TEST_F(Fric, IsContinuousFromStickToSlip) {
  auto below = call(2), above = call(2);
  move(below, 8 * (1 - 1e-12), 25); // 8 mm/s is the critical slip
  move(above, 8 * (1 + 1e-12), 25);
  run(below, four_axes());
  run(above, four_axes());
  EXPECT_EQ(size(below.slip), 0);
  EXPECT_GT(size(above.slip), 0);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(below.tau[i], above.tau[i], 1e-9 * size(above.tau));
}

TEST_F(Fric, ReturnsAtOnceWhereThePointWasOpenAndForgetsItsElasticSlip) {
  auto c = call(2);
  move(c, 50, 30);
  run(c, four_axes());
  EXPECT_NE(c.state[4], 0);
  const double slip = c.state[0];
  c.mode = 2;
  c.increment = 2;
  const std::vector<double> before = c.tau;
  for (int iteration = 0; iteration < 3; ++iteration) {
    c.run(four_axes());
    EXPECT_EQ(c.mode, 2);
    EXPECT_EQ(c.tau, before) << "nothing else is to be updated";
    EXPECT_EQ(c.state[4], 0);
    EXPECT_EQ(c.state[5], 0);
    EXPECT_EQ(c.state[0], slip);
  }
}

TEST_F(Fric, TakesAStickingPointOfAnotherLawsLMAsItsOwn) {
  auto c = call(1);
  c.mode = 1;
  move(c, 50);
  run(c, four_axes());
  EXPECT_EQ(c.mode, 0);
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, 100));
}

TEST_F(Fric, GivesNoStressWithoutPressureAndKeepsTheHistory) {
  for (const double pressure : {0.0, -50.0}) {
    auto c = call(2);
    c.state[0] = 3;
    c.state[2] = 800;
    c.pressure = pressure;
    move(c, 50, 30);
    run(c, four_axes());
    EXPECT_EQ(c.mode, 0);
    EXPECT_EQ(size(c.tau), 0);
    EXPECT_THAT(c.by_motion, testing::Each(0));
    EXPECT_THAT(c.by_temperature, testing::Each(0));
    EXPECT_THAT(c.by_pressure, testing::Each(0));
    EXPECT_EQ(c.state[0], 3);
    EXPECT_EQ(c.state[2], 800);
  }
}

TEST_F(Fric, BeginsWithThePressureWhereTheLawsStressDoesNot) {
  const Table table = test::one_axis_table(); // tau_R by psi alone
  static const TableFunction function(table);
  void* const routine_of_table = routine("one_axis", {table, "mm-t-s", {}});
  const double state[] = {psi};
  for (const auto& [pressure, share] : {std::pair{1000.0, 1.0}, {1.0, 1.0}, {0.25, 0.25}}) {
    auto c = call(1);
    c.properties = {psi, critical};
    c.pressure = pressure;
    move(c, 50);
    run(c, routine_of_table);
    EXPECT_CLOSE(c.tau[0], function(state) * share);
    EXPECT_CLOSE(c.by_pressure[0], share < 1 ? function(state) : 0);
  }
}

TEST_F(Fric, TakesIncrementsWithoutTimeAsStandingStill) {
  auto c = call(1);
  move(c, 50);
  c.time_increment = 0;
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], tau(1000, 0, 100));
}

TEST_F(Fric, TakesTheSolversLengthForTheCriticalSlipWhereTheDeckGivesNone) {
  for (const std::vector<double>& properties :
       {std::vector{psi, flow, 0.0}, std::vector{psi, flow}}) {
    auto c = call(1);
    c.properties = properties;
    c.length = 0.5;
    move(c, 1);
    run(c, four_axes());
    EXPECT_CLOSE(c.tau[0], tau(1000, 1, 100) * 0x1p-10 / 0.0025);
  }
}

TEST_F(Fric, HasACriticalSlipEvenWithoutAnyLength) {
  auto c = call(1);
  c.properties = {psi, flow};
  c.length = 0;
  move(c, 1);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], tau(1000, 1, 100));
  c = call(1);
  c.properties = {psi, flow};
  c.length = 0;
  run(c, four_axes()); // and standing still
  EXPECT_EQ(c.tau[0], 0);
  EXPECT_GT(c.by_motion[0], 0);
}

TEST_F(Fric, LeavesTheTimeStepToTheSolver) {
  auto c = call(1);
  c.step_scale = 0.75;
  move(c, 50);
  run(c, four_axes());
  EXPECT_EQ(c.step_scale, 0.75);
}

TEST_F(Fric, TakesTheMeanOfBothSurfacesTemperaturesAndHalfTheDerivativeForEach) {
  auto c = call(1);
  c.temperature[0] = 40;
  c.temperature[1] = 140;
  move(c, 50);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, 90));
  EXPECT_EQ(c.by_temperature[0], c.by_temperature[1]);
}

TEST_F(Fric, TakesATemperatureFromThePropertiesWhereTheModelHasNone) {
  void* const function =
      routine("no_temperature", {four_axis(), "mm-t-s", {{"T_contact_C", "property"}}});
  auto c = call(1);
  c.properties = {psi, 60, flow, critical};
  c.temperature[0] = c.temperature[1] = nan;
  move(c, 50);
  run(c, function);
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, 60));
  EXPECT_THAT(c.by_temperature, testing::Each(0));
}

TEST_F(Fric, GivesNaNForNaNInAnyArgumentItUsesAndKeepsTheState) {
  using Spoil = void (*)(FricCall&);
  const std::pair<const char*, Spoil> spoils[] = {
      {"PRESS", [](FricCall& c) { c.pressure = nan; }},
      {"DGAM", [](FricCall& c) { c.motion[1] = nan; }},
      {"DTIME", [](FricCall& c) { c.time_increment = nan; }},
      {"TEMP(1)", [](FricCall& c) { c.temperature[0] = nan; }},
      {"TEMP(2)", [](FricCall& c) { c.temperature[1] = nan; }},
      {"CHRLNGTH", [](FricCall& c) { c.length = nan; }},
      {"PROPS", [](FricCall& c) { c.properties[0] = nan; }},
      {"critical slip", [](FricCall& c) { c.properties[2] = nan; }},
      {"DROT", [](FricCall& c) { c.rotation[2] = nan; }},
      {"slip", [](FricCall& c) { c.state[0] = nan; }},
      {"elastic slip", [](FricCall& c) { c.state[5] = nan; }}};
  for (const auto& [name, spoil] : spoils) {
    auto c = call(2);
    move(c, 50, 30);
    spoil(c);
    const std::vector<double> before = c.state;
    run(c, four_axes());
    EXPECT_TRUE(std::isnan(c.tau[0]) && std::isnan(c.tau[1])) << name;
    EXPECT_THAT(c.by_motion, testing::Each(0)) << name;
    EXPECT_EQ(test::worst_relative(c.state, before), 0) << name;
  }
}

TEST_F(Fric, TakesInfinitiesAsFarOutsideTheTable) {
  auto c = call(2);
  c.pressure = inf; // beyond the shear limit
  move(c, 50, 30);
  run(c, four_axes());
  EXPECT_CLOSE(size(c.tau), 0.8 * 0.5773502691896258 * flow);
  c = call(2);
  c.motion[1] = -inf;
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[1], -tau(1000, 1e9, 100));
  c = call(1);
  c.temperature[0] = -inf;
  move(c, 50);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, -1e9));
}

TEST_F(Fric, UsesTheNearestEdgeOutsideEachSideOfEachAxisAndCountsTheIncrement) {
  const double states[][3] = {{100, 50, 100},    {4000, 50, 100}, {1000, 1, 100},
                              {1000, 2000, 100}, {1000, 50, -40}, {1000, 50, 900}};
  for (const auto& s : states) {
    auto c = call(1);
    c.properties[2] = 1e-9;
    c.pressure = s[0];
    c.temperature[0] = c.temperature[1] = s[2];
    move(c, s[1]);
    for (int iteration = 0; iteration < 3; ++iteration)
      run(c, four_axes());
    EXPECT_CLOSE(c.tau[0], tau(s[0], s[1], s[2]));
    EXPECT_EQ(c.state[3], 1);
  }
}

TEST_F(Fric, AddsSlipWorkAndPeakOncePerIncrementWhateverTheIterations) {
  // Either the solver passes the start of the increment in every iteration, or what the last
  // iteration left.
  for (const bool passes_start : {true, false}) {
    SCOPED_TRACE(passes_start);
    auto c = branching_call();
    c.time_increment = 0.125;
    double work = 0;
    for (int increment = 1; increment <= 3; ++increment) {
      c.increment = increment;
      const std::vector<double> start = c.state;
      for (int iteration = 0; iteration < 5; ++iteration) {
        if (passes_start) c.state = start;
        c.pressure = 250 + 10 * iteration + increment;
        move(c, 20 + 5 * iteration); // the last one counts: 40 mm/s, 5 mm
        run(c, branching());
      }
      const double slip = 5 * increment - critical;
      EXPECT_CLOSE(c.state[0], slip);
      EXPECT_CLOSE(c.tau[0], slip_tau(290 + increment, 40, slip));
      work += c.tau[0] * (increment == 1 ? 5 - critical : 5);
      EXPECT_CLOSE(c.state[1], work);
      EXPECT_EQ(c.state[2], 290 + increment) << "not the peak of an iteration";
      EXPECT_CLOSE(c.dissipation, c.tau[0] * c.slip[0]);
    }
  }
}

TEST_F(Fric, ForgetsAnIncrementThatWasCutBack) {
  for (const bool passes_start : {true, false}) {
    SCOPED_TRACE(passes_start);
    auto c = branching_call(2);
    c.time_increment = 0.125;
    move(c, 40, 10);
    run(c, branching());
    auto whole = c;
    for (FricCall* one : {&c, &whole}) {
      one->increment = 2;
      one->pressure = 400;
    }
    if (!passes_start) { // a first attempt, that fails
      c.pressure = 900;
      move(c, 48, 170);
      run(c, branching());
    }
    const auto second = [&](FricCall& one) {
      one.pressure = 400;
      one.time_increment = 0.03125;
      move(one, 30, 20);
      run(one, branching());
    };
    second(c);
    second(c);
    second(whole);
    EXPECT_EQ(c.state, whole.state);
    EXPECT_EQ(c.tau, whole.tau);
    EXPECT_EQ(c.by_motion, whole.by_motion);
  }
}

TEST_F(Fric, CountsOnInTheNextStepThoughItsIncrementsBeginAgain) {
  auto c = branching_call();
  c.time_increment = 0.125;
  for (int step = 1; step <= 3; ++step) {
    c.step = step;
    move(c, 40);
    run(c, branching());
    run(c, branching());
    EXPECT_CLOSE(c.state[0], 5 * step - critical);
  }
}

TEST_F(Fric, TurnsTheElasticSlipWithTheSurface) {
  auto c = call(2);
  move(c, 50, 30);
  run(c, four_axes());
  c.increment = 2;
  const double turn[] = {0, 1, -1, 0}; // by columns: direction 1 becomes 2
  std::copy(turn, turn + 4, c.rotation);
  move(c, 0);
  run(c, four_axes());
  EXPECT_NEAR(c.tau[0], -0.5 * tau(1000, 0, 100), 1e-11);
  EXPECT_NEAR(c.tau[1], std::sqrt(0.75) * tau(1000, 0, 100), 1e-11);
}

TEST_F(Fric, WorksWithoutStateVariablesFromTheStressOfTheIncrementsStart) {
  for (const int states : {0, 1, 14}) {
    auto c = call(2);
    c.states = states;
    c.resize();
    move(c, 50, 30);
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100));
    move(c, 1, 210); // back, elastically
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100) - tau(1000, 1, 100) * 0x1p-10 / critical);
    EXPECT_THAT(c.state, testing::Each(0));
  }
}

TEST_F(Fric, WritesNothingBeyondItsStateVariables) {
  auto c = call(2);
  c.states = 18;
  c.resize();
  move(c, 50, 30);
  run(c, four_axes());
  EXPECT_EQ(c.state[15] + c.state[16] + c.state[17], 0);
}

TEST_F(Fric, TakesStatesFromFieldsAndConstantsAsTheJobSays) {
  static const TableFunction table(four_axis());
  void* const function =
      routine("fields",
              {four_axis(),
               "mm-t-s",
               {{"psi", "field:2"}, {"sigma_f_MPa", "constant:300"}, {"T_contact_C", "field:1"}}});
  auto c = call(1);
  c.properties = {critical};
  c.predefined = 2;
  c.resize();
  c.field = {80, 40, 3, 5}; // PREDEF(1,1), PREDEF(2,1), PREDEF(1,2), PREDEF(2,2)
  move(c, 50);
  run(c, function);
  const double state[] = {1000, 4, 50, 60, 300};
  EXPECT_CLOSE(c.tau[0], table(state));
  c.predefined = 1; // field 2 is not there: the middle of the axis
  c.state.assign(15, 0);
  run(c, function);
  const double fallback[] = {1000, std::sqrt(20.0), 50, 60, 300};
  EXPECT_CLOSE(c.tau[0], table(fallback));
}

TEST_F(Fric, TakesTypicalValuesForPropertiesTheDeckDoesNotGive) {
  static const TableFunction table(four_axis());
  auto c = call(1);
  c.properties.clear();
  move(c, 50);
  run(c, four_axes());
  const double state[] = {1000, std::sqrt(20.0), 50, 100, 480};
  EXPECT_CLOSE(c.tau[0], table(state));
}

// Peak pressure and friction work as states of the law.
Table histories() {
  Table table;
  table.model = "histories";
  for (const auto& [name, unit, high] :
       {std::tuple{"peak_sigma_n", "MPa", 2000.0}, {"friction_work", "MPa mm", 500.0}}) {
    TableAxis axis;
    axis.name = name;
    axis.unit = unit;
    axis.nodes = {0, high};
    table.axes.push_back(axis);
  }
  table.value = {0.05, 0.09, 0.2, 0.3};
  table.combine = Expr::symbol("value") * Expr::symbol("sigma_n_MPa");
  return table;
}

TEST_F(Fric, FollowsPeakPressureAndFrictionWorkInBothUnitSystems) {
  static const Table table = histories();
  static const TableFunction function(table);
  for (const std::string units : {"mm-t-s", "m-kg-s"}) {
    SCOPED_TRACE(units);
    const bool metre = units == "m-kg-s";
    const double stress = metre ? 1e6 : 1, length = metre ? 1e-3 : 1;
    const std::vector<std::string> inputs = table.inputs();
    const auto wanted = [&](double pressure, double peak, double work) {
      std::vector<double> state;
      for (const std::string& name : inputs)
        state.push_back(name == "peak_sigma_n" ? peak : name == "friction_work" ? work : pressure);
      return function(state);
    };
    auto c = call(1);
    c.properties = {critical * length};
    double work = 0;
    for (const double pressure : {800.0, 500.0}) {
      c.pressure = pressure * stress;
      c.motion[0] = (1 + critical) * length;
      run(c, routine("histories " + units, {table, units, {}}));
      EXPECT_CLOSE(c.tau[0], wanted(pressure, 800, work) * stress);
      work += wanted(pressure, 800, work) * (c.increment == 1 ? 1 : 1 + critical);
      EXPECT_CLOSE(c.state[1], work * stress * length);
      expect_tangents(c, routine("histories " + units, {table, units, {}}), "histories");
      ++c.increment;
    }
    auto light = call(1); // below the smallest pressure the peak still counts
    light.properties = {critical * length};
    light.pressure = 0.4 * stress;
    light.motion[0] = length;
    expect_tangents(light, routine("histories " + units, {table, units, {}}), "light");
  }
}

TEST_F(Fric, ConvertsUnitsOfMetreKilogramSecondAndTheirDerivatives) {
  void* const si = routine("si", {four_axis(), "m-kg-s", {}});
  auto c = call(2), metre = call(2);
  metre.properties = {psi, flow * 1e6, critical * 1e-3};
  metre.pressure = 1000e6;
  for (const double speed : {2.0, 50.0}) {
    c.state.assign(15, 0), metre.state.assign(15, 0);
    move(c, speed, 30);
    move(metre, speed * 1e-3, 30);
    run(c, four_axes());
    run(metre, si);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(metre.tau[i], c.tau[i] * 1e6, 1e-6 * bound * size(c.tau) * 1e12);
      EXPECT_NEAR(metre.by_pressure[i], c.by_pressure[i], 1e-9);
      EXPECT_NEAR(metre.by_temperature[i], c.by_temperature[i] * 1e6, 1e-3);
    }
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(metre.by_motion[i], c.by_motion[i] * 1e9, 1e-11 * 1e9 * std::abs(c.by_motion[0]));
  }
}

TEST_F(Fric, HoldsTheCoefficientOfTheLastIncrementWhereAsked) {
  static const ExportRequest request{
      four_axis(), "mm-t-s", {}, {{"abaqus_coefficient", "start_of_increment"}}};
  void* const frozen = routine("frozen", request);
  auto c = call(2);
  move(c, 50, 30);
  run(c, frozen);
  EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100)) << "the first increment has no other";
  const double held = tau(1000, 50, 100) / 1000;
  for (int iteration = 0; iteration < 3; ++iteration) {
    c.increment = 2;
    c.pressure = 700 + 50 * iteration;
    c.temperature[0] = 180;
    move(c, 300, 30);
    run(c, frozen);
    EXPECT_CLOSE(size(c.tau), held * c.pressure);
    EXPECT_CLOSE(size(c.by_pressure), held);
    EXPECT_THAT(c.by_temperature, testing::Each(0));
  }
  expect_tangents(c, frozen, "held");
  c.increment = 3;
  run(c, frozen);
  EXPECT_CLOSE(size(c.tau), tau(800, 300, 140)) << "what increment 2 ended with";
}

// A massless point on springs of 4000 MPa/mm, pulled round a circle of 2 mm: Newton's method as an
// implicit solver does it, from rest over stick and slip. Gives the iterations it took.
int pull_round(void* function, FricCall& c, double& dissipated) {
  constexpr double spring = 4000;
  double u[2] = {0, 0};
  int iterations = 0;
  for (c.increment = 1; c.increment <= 120; ++c.increment) {
    const double turn = 2 * std::numbers::pi * c.increment / 100;
    const double pull[2] = {2 * (std::cos(turn) - 1), 2 * std::sin(turn)};
    const std::vector<double> start = c.state;
    c.motion = {0, 0};
    for (int iteration = 1;; ++iteration, ++iterations) {
      c.state = start;
      c.run(function);
      double r[2], j[2][2];
      for (std::size_t a = 0; a < 2; ++a) {
        r[a] = spring * (pull[a] - u[a] - c.motion[a]) - c.tau[a];
        for (std::size_t b = 0; b < 2; ++b)
          j[a][b] = (a == b ? spring : 0) + c.by_motion[a + 2 * b];
      }
      if (std::hypot(r[0], r[1]) < 1e-9) break;
      if (iteration == 30) return -1;
      const double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
      c.motion[0] += (j[1][1] * r[0] - j[0][1] * r[1]) / det;
      c.motion[1] += (j[0][0] * r[1] - j[1][0] * r[0]) / det;
    }
    for (std::size_t a = 0; a < 2; ++a)
      u[a] += c.motion[a];
    dissipated += c.dissipation;
  }
  return iterations;
}

TEST_F(Fric, LetsNewtonsMethodConvergeOverStickAndSlip) {
  void* const frozen = routine(
      "frozen", {four_axis(), "mm-t-s", {}, {{"abaqus_coefficient", "start_of_increment"}}});
  for (void* const function : {four_axes(), frozen}) {
    auto c = call(2);
    c.time_increment = 0x1p-8; // 32 mm/s along the circle
    double dissipated = 0;
    const int iterations = pull_round(function, c, dissipated);
    ASSERT_GT(iterations, 0) << "an increment without an equilibrium";
    EXPECT_LT(iterations, 120 * 6);
    EXPECT_GT(c.state[0], 10) << "it slipped most of 15 mm";
    EXPECT_NEAR(c.state[1], dissipated, 1e-9 * dissipated);
  }
}

TEST_F(Fric, EndsTheAnalysisBeyondAnErrorSideAndNamesIt) {
  const ExportRequest request{test::sides_table(), "mm-t-s", {}};
  const Exporter& exporter = *find_exporter("abaqus_fric");
  BuildVariant variant = exporter.variants(request)[0];
  variant.extra["stdb_abqerr.f"] = "      subroutine stdb_abqerr(lop, text, intv, realv, charv)\n"
                                   "      include 'aba_param.inc'\n"
                                   "      character*(*) text, charv(*)\n"
                                   "      dimension intv(*), realv(*)\n"
                                   "      character*500 said\n"
                                   "      integer calls, kind\n"
                                   "      common /ftseen/ calls, kind, said\n"
                                   "      calls = calls + 1\n"
                                   "      kind = lop\n"
                                   "      said = text\n"
                                   "      end\n";
  struct Seen {
    int calls, kind;
    char said[500];
  };
  TemporaryDirectory work;
  const Library library(compile_library(exporter.generate(request), variant, work.path()));
  const Seen& seen = *library.find<Seen>("ftseen_");
  auto c = call(1);
  c.properties = {flow, critical};
  move(c, 400);
  run(c, Library::address(library.handle(), "fric_"));
  EXPECT_EQ(seen.calls, 0);
  move(c, 600);
  run(c, Library::address(library.handle(), "fric_"));
  EXPECT_EQ(seen.calls, 1);
  EXPECT_EQ(seen.kind, -3);
  EXPECT_THAT(std::string(seen.said, 500), testing::HasSubstr("v_rel_mm_s above 500"));
  EXPECT_TRUE(std::isnan(c.tau[0])) << "where the solver's routine comes back";
}

TEST_F(Fric, CompilesWithoutAWarningForEveryTableAndChoice) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const std::string choice : {"current", "start_of_increment"}) {
      SCOPED_TRACE(sample.name + " " + choice);
      EXPECT_NO_THROW(routine("warnings " + sample.name + choice,
                              {sample.table, "m-kg-s", {}, {{"abaqus_coefficient", choice}}}));
    }
}

TEST_F(Fric, MayRunInThreadsAtOnce) {
  // Not with -fcheck=recursion: its own flag is shared by all threads.
  void* const function =
      Library::address(test::compiled("threads", *find_exporter("abaqus_fric"),
                                      {four_axis(), "mm-t-s", {}}, "double", {"-O2"})
                           ->handle(),
                       "fric_");
  const auto history = [function](double angle) {
    auto c = call(2);
    for (int increment = 1; increment <= 300; ++increment) {
      c.increment = increment;
      move(c, increment, angle * increment);
      c.run(function);
    }
    return c.state;
  };
  std::vector<std::vector<double>> found(4);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < found.size(); ++i)
    threads.emplace_back([&, i] { found[i] = history(7.0 + double(i)); });
  for (std::thread& thread : threads)
    thread.join();
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_EQ(found[i], history(7.0 + double(i)));
}

TEST(FricRecipe, TellsDepvarPropertiesAndTheUnsymmetricSolver) {
  const ExportRequest request{four_axis(), "m-kg-s", {}};
  const auto out =
      nlohmann::json::parse(find_exporter("abaqus_fric")->generate(request).at("recipe.json"));
  EXPECT_EQ(out["entry"], "fric");
  EXPECT_THAT(std::string(out["input_deck"]),
              testing::AllOf(testing::HasSubstr("*Friction, user, depvar=15, properties=3\n"
                                                " 4.47214, 4.8e+08, 0.\n"),
                             testing::HasSubstr("unsymm=YES")));
  EXPECT_EQ(out["properties"][2]["quantity"], "critical_slip");
  EXPECT_EQ(out["properties"][2]["unit"], "m");
  EXPECT_EQ(out["state_variables"].size(), 15U);
  EXPECT_EQ(out["state_variables"][8]["unit"], "m");
  EXPECT_EQ(out["options"]["abaqus_coefficient"], "current");
  EXPECT_THAT(std::string(out["signature_source"]),
              testing::AllOf(testing::HasSubstr("verified:"), testing::HasSubstr("Recalled")));
}

} // namespace

} // namespace frictab
