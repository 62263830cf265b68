// FRIC of Abaqus/Standard: its derivatives are those of the routine itself, and Newton's method
// converges with them.
#include <cmath>

#include <gtest/gtest.h>

#include "routines/fric_case.h"

namespace frictab::fric_tangent_test {

namespace {

using namespace test;

class FricTangents : public FricCase {
protected:
  static void* frozen() {
    return routine("frozen",
                   {four_axis(), "mm-t-s", {}, {{"abaqus_coefficient", "start_of_increment"}}});
  }
};

TEST_F(FricTangents, TangentsOfSlipAndStickAreThoseOfItsOwnDifferences) {
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

TEST_F(FricTangents, TangentsHoldWhereTheLimitFollowsTheSlipItself) {
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

TEST_F(FricTangents, TangentsHoldWhereALawTakesTheSlipByBothOfItsNames) {
  void* const two_slips = routine("two slips", {two_slips_table(), "mm-t-s", {}});
  for (const int directions : {1, 2}) {
    auto c = call(directions);
    c.properties = {critical};
    c.time_increment = 0.125;
    move(c, 12, directions == 1 ? 0 : 35);
    expect_tangents(c, two_slips, "two slips");
  }
}

TEST_F(FricTangents, TangentsHoldWithoutStateVariablesFromTheStressOfTheStart) {
  for (const int directions : {1, 2})
    for (const double speed : {0.5, 6.0, 50.0, 300.0}) // from stick into slip
      for (const double share : {0.3, 0.9, 1.5}) {     // of the limit: the stress of the start
        auto c = call(directions);
        c.states = 0;
        c.resize();
        c.tau[0] = share * tau(1000, 1, 100);
        if (directions == 2) c.tau[1] = 0.4 * c.tau[0];
        move(c, speed, directions == 1 ? 0 : 100);
        for (void* const function : {four_axes(), frozen()})
          expect_tangents(c, function, std::to_string(speed) + " " + std::to_string(share));
      }
}

TEST_F(FricTangents, TangentsHoldBelowTheSmallestPressureAndAtTheShearLimit) {
  for (const double pressure : {0.01, 0.7, 2200.0, 9000.0})
    for (const double speed : {3.0, 40.0}) {
      auto c = call(2);
      c.pressure = pressure;
      move(c, speed, 20);
      expect_tangents(c, four_axes(), std::to_string(pressure));
    }
}

TEST_F(FricTangents, IsContinuousFromStickToSlip) {
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

TEST_F(FricTangents, ConvertsUnitsOfMetreKilogramSecondAndTheirDerivatives) {
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
      EXPECT_NEAR(metre.tau[i], c.tau[i] * 1e6, 1e-19 * size(c.tau) * 1e12);
      EXPECT_NEAR(metre.by_pressure[i], c.by_pressure[i], 1e-9);
      EXPECT_NEAR(metre.by_temperature[i], c.by_temperature[i] * 1e6, 1e-3);
    }
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(metre.by_motion[i], c.by_motion[i] * 1e9, 1e-11 * 1e9 * std::abs(c.by_motion[0]));
  }
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

TEST_F(FricTangents, LetsNewtonsMethodConvergeOverStickAndSlip) {
  for (void* const function : {four_axes(), frozen()}) {
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

} // namespace

} // namespace frictab::fric_tangent_test
