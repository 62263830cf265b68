// FRIC called as Abaqus/Standard calls it, with bounds checked and floating point traps on: what
// its tests have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "routines/standard_case.h"
#include "support/calls/fric.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::test {

using calls::FricCall;

inline constexpr double critical = 0x1p-7; // mm, the elastic slip at which sticking ends

class FricCase : public NeedsGfortran {
protected:
  static void* routine(const std::string& key, const codegen::ExportRequest& request) {
    return codegen::Library::address(
        compiled(key, *codegen::find_exporter("abaqus_fric"), request, "double", strict)->handle(),
        "fric_");
  }
  static void* four_axes() { return routine("four_axes", {four_axis(), "mm-t-s", {}}); }
  static const table::Table& slipping() { // by speed and sliding distance
    static const table::Table table = branching_table();
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
    const FloatTraps traps;
    c.run(function);
  }

  static double tau(double pressure, double speed, double temperature) {
    return four_axis_tau(pressure, speed, temperature);
  }
  static double slip_tau(double pressure, double speed, double slip) {
    static const table::TableFunction table(slipping());
    const double state[] = {pressure, speed, slip, flow};
    return table(state);
  }
  static double size(const std::vector<double>& a) {
    return a.size() == 1 ? std::abs(a[0]) : std::hypot(a[0], a[1]);
  }
};

// Every derivative against the central difference of the routine itself.
inline void expect_tangents(const FricCall& start, void* function, const std::string& what) {
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
  // Short beside the slip: the first state of rate-and-state friction goes with its inverse.
  const double slip = std::hypot(start.motion[0], n > 1 ? start.motion[1] : 0.0);
  const double slip_step = slip > 0 ? std::min(1e-8, 1e-4 * slip) : 1e-8;
  for (std::size_t j = 0; j < n; ++j)
    compare([j](FricCall& c) -> double& { return c.motion[j]; }, slip_step,
            [&, j](const FricCall& c, std::size_t i) { return c.by_motion[i + n * j]; },
            j == 0 ? "DDTDDG(,1)" : "DDTDDG(,2)");
  compare([](FricCall& c) -> double& { return c.pressure; }, 1e-5 * start.pressure,
          [](const FricCall& c, std::size_t i) { return c.by_pressure[i]; }, "DDTDDP");
  for (std::size_t side = 0; side < 2; ++side)
    compare([side](FricCall& c) -> double& { return c.temperature[side]; }, 1e-3,
            [&, side](const FricCall& c, std::size_t i) { return c.by_temperature[i + n * side]; },
            "DDTDDT");
}

} // namespace frictab::test
