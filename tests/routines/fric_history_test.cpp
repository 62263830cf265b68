// FRIC of Abaqus/Standard: histories count once per increment, whatever the solver's iterations.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "routines/fric_case.h"
#include "support/solver_scale.h"

namespace frictab::fric_history_test {

namespace {

using namespace test;

class FricHistory : public FricCase {};

TEST_F(FricHistory, AddsSlipWorkAndPeakOncePerIncrementWhateverTheIterations) {
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
      EXPECT_CLOSE(c.state[0], slip, 1e-13);
      EXPECT_CLOSE(c.tau[0], slip_tau(290 + increment, 40, slip), 1e-13);
      work += c.tau[0] * (increment == 1 ? 5 - critical : 5);
      EXPECT_CLOSE(c.state[1], work, 1e-13);
      EXPECT_EQ(c.state[2], 290 + increment) << "not the peak of an iteration";
      EXPECT_CLOSE(c.dissipation, c.tau[0] * c.slip[0], 1e-13);
    }
  }
}

TEST_F(FricHistory, ForgetsAnIncrementThatWasCutBack) {
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

TEST_F(FricHistory, CountsOnInTheNextStepThoughItsIncrementsBeginAgain) {
  auto c = branching_call();
  c.time_increment = 0.125;
  for (int step = 1; step <= 3; ++step) {
    c.step = step;
    move(c, 40);
    run(c, branching());
    run(c, branching());
    EXPECT_CLOSE(c.state[0], 5 * step - critical, 1e-13);
  }
}

TEST_F(FricHistory, TurnsTheElasticSlipWithTheSurface) {
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

TEST_F(FricHistory, WorksWithoutStateVariablesFromTheStressOfTheIncrementsStart) {
  for (const int states : {0, 1, 14}) {
    auto c = call(2);
    c.states = states;
    c.resize();
    move(c, 50, 30);
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100), 1e-13);
    move(c, 1, 210); // back, elastically
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100) - tau(1000, 1, 100) * 0x1p-10 / critical, 1e-13);
    EXPECT_THAT(c.state, testing::Each(0));
  }
}

TEST_F(FricHistory, FollowsPeakPressureAndFrictionWorkInEveryUnitSystem) {
  static const table::Table table = peak_and_work_table();
  static const table::TableFunction function(table);
  for (const test::SolverScale& scale : test::every_system()) {
    SCOPED_TRACE(scale.name);
    const double stress = scale.stress, length = scale.length;
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
      run(c, routine("histories " + scale.name, {table, scale.units, {}}));
      EXPECT_CLOSE(c.tau[0], wanted(pressure, 800, work) * stress, 1e-13);
      work += wanted(pressure, 800, work) * (c.increment == 1 ? 1 : 1 + critical);
      EXPECT_CLOSE(c.state[1], work * stress * length, 1e-13);
      expect_tangents(c, routine("histories " + scale.name, {table, scale.units, {}}), "histories");
      ++c.increment;
    }
    auto light = call(1); // below the smallest pressure the peak still counts
    light.properties = {critical * length};
    light.pressure = 0.4 * stress;
    light.motion[0] = length;
    expect_tangents(light, routine("histories " + scale.name, {table, scale.units, {}}), "light");
  }
}

TEST_F(FricHistory, HoldsTheCoefficientOfTheLastIncrementWhereAsked) {
  static const codegen::ExportRequest request{
      four_axis(), "mm-t-s", {}, {{"abaqus_coefficient", "start_of_increment"}}};
  void* const frozen = routine("frozen", request);
  auto c = call(2);
  move(c, 50, 30);
  run(c, frozen);
  EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100), 1e-13) << "the first increment has no other";
  const double held = tau(1000, 50, 100) / 1000;
  for (int iteration = 0; iteration < 3; ++iteration) {
    c.increment = 2;
    c.pressure = 700 + 50 * iteration;
    c.temperature[0] = 180;
    move(c, 300, 30);
    run(c, frozen);
    EXPECT_CLOSE(size(c.tau), held * c.pressure, 1e-13);
    EXPECT_CLOSE(size(c.by_pressure), held, 1e-13);
    EXPECT_THAT(c.by_temperature, testing::Each(0));
  }
  expect_tangents(c, frozen, "held");
  c.increment = 3;
  run(c, frozen);
  EXPECT_CLOSE(size(c.tau), tau(800, 300, 140), 1e-13) << "what increment 2 ended with";
}

} // namespace

} // namespace frictab::fric_history_test
