// FRIC_COEF of Abaqus/Standard, list of 2024: what its state variables keep over the solver's
// iterations.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "routines/abaqus_routines.h"
#include "support/solver_scale.h"

namespace frictab::fric_coef_states_test {

using table::Table;

namespace {

using namespace test;
using calls::CoefCall;

// The list of 2024 has slip and state variables.
class FricCoef2024 : public NeedsGfortran, protected CoefficientCase<CoefCall> {
protected:
  static CoefCall call(std::vector<double> properties) {
    CoefCall c;
    c.temperatures = true;
    c.states = 11;
    c.properties = std::move(properties);
    c.resize(1);
    set(c, 0, 1000, 50, 100);
    return c;
  }
  static void run(CoefCall& c, void* function) {
    const FloatTraps traps;
    c.run(function);
  }
};

TEST_F(FricCoef2024, TakesTheEquivalentSlipAndGivesItsDerivative) {
  static const Table table = branching_table();
  for (const test::SolverScale& scale : test::every_system()) {
    const double length = scale.length, stress = scale.stress;
    void* const compiled = routine("states branching " + scale.name, table, {}, scale.units);
    auto c = call({flow * stress});
    c.pressure[0] = 300 * stress;
    c.slip[0] = 20 * scale.speed;
    c.slip[3] = 7 * length;
    run(c, compiled);
    EXPECT_CLOSE(c.coefficient[0], branching_tau(300, 20, 7) / 300, 1e-13);
    EXPECT_NEAR(c.derivative[5] * length,
                (branching_tau(300, 20, 7.001) - branching_tau(300, 20, 6.999)) / 300 / 0.002,
                1e-9);
    EXPECT_EQ(c.derivative[6], 0);
  }
}

TEST_F(FricCoef2024, GivesTheDerivativeOfALawThatTakesTheSlipByBothOfItsNames) {
  static const Table table = two_slips_table();
  for (const test::SolverScale& scale : test::every_system()) {
    const double length = scale.length, stress = scale.stress;
    auto c = call({});
    c.pressure[0] = 300 * stress;
    c.slip[3] = 7 * length;
    run(c, routine("two slips " + scale.name, table, {}, scale.units));
    EXPECT_CLOSE(c.coefficient[0], 0.08 + 7 * 5e-3, 1e-13);
    EXPECT_NEAR(c.derivative[5] * length, 5e-3, 1e-15);
  }
}

TEST_F(FricCoef2024, KeepsPeakAndWorkOncePerIncrementWhateverTheIterations) {
  static const Table table = peak_and_work_table();
  static const table::TableFunction function(table);
  void* const compiled = routine("peaks", table);
  const std::vector<std::string> inputs = table.inputs();
  const auto wanted = [&](double pressure, double peak, double work) {
    std::vector<double> state;
    for (const std::string& name : inputs)
      state.push_back(name == "peak_sigma_n" ? peak : name == "friction_work" ? work : pressure);
    return function(state);
  };
  for (const bool passes_start : {true, false}) {
    SCOPED_TRACE(passes_start);
    auto c = call({});
    double work = 0, peak = 0;
    for (int increment = 1; increment <= 3; ++increment) {
      c.increment = increment;
      const std::vector<double> start = c.state;
      for (int iteration = 0; iteration < 5; ++iteration) {
        if (passes_start) c.state = start;
        c.pressure[0] = 900 - 100 * increment - 10 * iteration; // the last one counts
        c.slip[3] = 0.1 * iteration + 0.4 * (increment - 1);
        run(c, compiled);
      }
      peak = std::max(peak, c.pressure[0]);
      const double tau = wanted(c.pressure[0], peak, work);
      EXPECT_CLOSE(c.coefficient[0] * c.pressure[0], tau, 1e-13);
      work += tau * 0.4;
      EXPECT_NEAR(c.state[0], work, 1e-12 * work);
      EXPECT_EQ(c.state[1], peak);
    }
  }
}

TEST_F(FricCoef2024, HasNoHistoryWithFewerStateVariablesOrInBlocks) {
  static const Table table = peak_and_work_table();
  void* const compiled = routine("peaks", table);
  for (const int states : {0, 10}) {
    auto c = call({});
    c.states = states;
    c.state.assign(static_cast<std::size_t>(states), 5);
    run(c, compiled);
    EXPECT_THAT(c.state, testing::Each(5));
  }
  auto c = call({});
  c.resize(2);
  c.state.assign(11, 5);
  c.pressure = {1000, 500};
  run(c, compiled);
  EXPECT_THAT(c.state, testing::Each(5));
  EXPECT_GT(c.coefficient[0], c.coefficient[1]) << "the peak pressure is the pressure";
}

TEST_F(FricCoef2024, CountsIncrementsOutsideTheRangeOnce) {
  void* const compiled = four_axes();
  auto c = call({psi, 60, flow});
  for (const double speed : {50.0, 900.0, 1000.0, 60.0}) {
    c.slip[0] = speed;
    for (int iteration = 0; iteration < 3; ++iteration)
      run(c, compiled);
    ++c.increment;
  }
  EXPECT_EQ(c.state[2], 2);
}

TEST_F(FricCoef2024, HoldsTheCoefficientOfTheLastIncrementWhereAsked) {
  options["abaqus_coefficient"] = "start_of_increment";
  void* const compiled = routine("frozen", four_axis());
  const auto mu = [](double pressure, double speed) {
    return four_axis_tau(pressure, speed, 100) / pressure;
  };
  auto c = call({psi, 60, flow});
  run(c, compiled);
  EXPECT_CLOSE(c.coefficient[0], mu(1000, 50), 1e-13);
  EXPECT_NE(c.derivative[1], 0);
  c.increment = 2;
  for (const double pressure : {700.0, 800.0, 900.0}) { // with a cutback among them
    c.time_increment *= 0.5;
    c.pressure[0] = pressure;
    c.slip[0] = 200;
    run(c, compiled);
    EXPECT_CLOSE(c.coefficient[0], mu(1000, 50), 1e-13);
    for (std::size_t i = 0; i < 20; ++i)
      EXPECT_EQ(c.derivative[i], 0);
  }
  c.increment = 3;
  run(c, compiled);
  EXPECT_CLOSE(c.coefficient[0], mu(900, 200), 1e-13) << "what increment 2 ended with";
}

TEST_F(FricCoef2024, GivesNaNForANaNHistoryAndKeepsIt) {
  void* const compiled = four_axes();
  auto c = call({psi, 60, flow});
  c.state[1] = nan;
  run(c, compiled);
  EXPECT_TRUE(std::isnan(c.coefficient[0]));
  EXPECT_EQ(c.state[0], 0);
}

} // namespace

} // namespace frictab::fric_coef_states_test
