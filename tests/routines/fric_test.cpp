// FRIC of Abaqus/Standard: its stress, and every trap of its argument list that is known, by name.
#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "routines/fric_case.h"
#include "support/error_routine.h"
#include "support/json.h"

namespace frictab::fric_test {

using codegen::Library;

namespace {

using namespace test;

class Fric : public FricCase {};

using LongFric = Fric;

TEST_F(Fric, GivesTheLimitAlongPositiveAndNegativeSlipInOneDirection) {
  for (const double speed : {50.0, -50.0}) {
    auto c = call(1);
    move(c, speed);
    run(c, four_axes());
    EXPECT_EQ(c.mode, 0);
    EXPECT_CLOSE(c.tau[0], std::copysign(tau(1000, 50, 100), speed), 1e-13); // 50 mm/s: 0.0488 mm
    EXPECT_CLOSE(c.slip[0], std::copysign(50 * 0x1p-10 - critical, speed), 1e-13);
  }
}

TEST_F(Fric, GivesTheLimitAlongTheSlipInTwoDirections) {
  for (const double angle : {0.0, 30.0, 135.0, 250.0}) {
    auto c = call(2);
    move(c, 50, angle);
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 50, 100), 1e-13) << angle;
    EXPECT_NEAR(c.tau[0] * c.motion[1] - c.tau[1] * c.motion[0], 0, 1e-13) << angle;
    EXPECT_GT(c.tau[0] * c.motion[0] + c.tau[1] * c.motion[1], 0) << angle;
  }
}

TEST_F(Fric, SticksElasticallyBelowTheCriticalSlip) {
  for (const int directions : {1, 2}) {
    auto c = call(directions);
    move(c, 2, directions == 1 ? 0 : 60); // 0.00195 mm; the table's slowest 5 mm/s
    run(c, four_axes());
    EXPECT_CLOSE(size(c.tau), tau(1000, 2, 100) * 2 * 0x1p-10 / critical, 1e-13);
    EXPECT_EQ(size(c.slip), 0);
    EXPECT_EQ(c.state[0], 0);
    EXPECT_EQ(c.dissipation, 0);
    EXPECT_CLOSE(c.elastic_energy, 0.5 * size(c.tau) * 2 * 0x1p-10, 1e-13);
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
  EXPECT_CLOSE(c.tau[0], limit * (critical - 0x1p-10) / critical, 1e-13);
  EXPECT_EQ(c.slip[0], 0);
  c.increment = 3;
  move(c, -50);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], -tau(1000, 50, 100), 1e-13);
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
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, 100), 1e-13);
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
  const table::Table table = one_axis_table(); // tau_R by psi alone
  static const table::TableFunction function(table);
  void* const routine_of_table = routine("one_axis", {table, "mm-t-s", {}});
  const double state[] = {psi};
  for (const auto& [pressure, share] : {std::pair{1000.0, 1.0}, {1.0, 1.0}, {0.25, 0.25}}) {
    auto c = call(1);
    c.properties = {psi, critical};
    c.pressure = pressure;
    move(c, 50);
    run(c, routine_of_table);
    EXPECT_CLOSE(c.tau[0], function(state) * share, 1e-13);
    EXPECT_CLOSE(c.by_pressure[0], share < 1 ? function(state) : 0, 1e-13);
  }
}

TEST_F(Fric, TakesIncrementsWithoutTimeAsStandingStill) {
  auto c = call(1);
  move(c, 50);
  c.time_increment = 0;
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], tau(1000, 0, 100), 1e-13);
}

TEST_F(Fric, TakesTheSolversLengthForTheCriticalSlipWhereTheDeckGivesNone) {
  for (const std::vector<double>& properties :
       {std::vector{psi, flow, 0.0}, std::vector{psi, flow}}) {
    auto c = call(1);
    c.properties = properties;
    c.length = 0.5;
    move(c, 1);
    run(c, four_axes());
    EXPECT_CLOSE(c.tau[0], tau(1000, 1, 100) * 0x1p-10 / 0.0025, 1e-13);
  }
}

TEST_F(Fric, HasACriticalSlipEvenWithoutAnyLength) {
  auto c = call(1);
  c.properties = {psi, flow};
  c.length = 0;
  move(c, 1);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], tau(1000, 1, 100), 1e-13);
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
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, 90), 1e-13);
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
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, 60), 1e-13);
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
    EXPECT_EQ(worst_relative(c.state, before), 0) << name;
  }
}

TEST_F(Fric, TakesInfinitiesAsFarOutsideTheTable) {
  auto c = call(2);
  c.pressure = inf; // beyond the shear limit
  move(c, 50, 30);
  run(c, four_axes());
  EXPECT_CLOSE(size(c.tau), 0.8 * 0.5773502691896258 * flow, 1e-13);
  c = call(2);
  c.motion[1] = -inf;
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[1], -tau(1000, 1e9, 100), 1e-13);
  c = call(1);
  c.temperature[0] = -inf;
  move(c, 50);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], tau(1000, 50, -1e9), 1e-13);
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
    EXPECT_CLOSE(c.tau[0], tau(s[0], s[1], s[2]), 1e-13);
    EXPECT_EQ(c.state[3], 1);
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
  EXPECT_CLOSE(c.tau[0], four_axis_tau(1000, 50, 60, 4, 300), 1e-13);
  c.predefined = 1; // field 2 is not there: the middle of the axis
  c.state.assign(15, 0);
  run(c, function);
  EXPECT_CLOSE(c.tau[0], four_axis_tau(1000, 50, 60, std::sqrt(20.0), 300), 1e-13);
}

TEST_F(Fric, TakesTypicalValuesForPropertiesTheDeckDoesNotGive) {
  auto c = call(1);
  c.properties.clear();
  move(c, 50);
  run(c, four_axes());
  EXPECT_CLOSE(c.tau[0], four_axis_tau(1000, 50, 100, std::sqrt(20.0)), 1e-13);
}

TEST_F(Fric, EndsTheAnalysisBeyondAnErrorSideAndNamesIt) {
  const codegen::ExportRequest request{sides_table(), "mm-t-s", {}};
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_fric");
  codegen::BuildVariant variant = exporter.variants(request)[0];
  test::keep_what_is_told(variant);
  frictab::TemporaryDirectory work;
  const Library library(codegen::compile_library(exporter.generate(request), variant, work.path()));
  const test::Told& told = test::told(library);
  auto c = call(1);
  c.properties = {flow, critical};
  move(c, 400);
  run(c, Library::address(library.handle(), "fric_"));
  EXPECT_EQ(told.calls, 0);
  move(c, 600);
  run(c, Library::address(library.handle(), "fric_"));
  EXPECT_EQ(told.calls, 1);
  EXPECT_EQ(told.kind, -3);
  EXPECT_THAT(told.said(), testing::HasSubstr("v_rel_mm_s above 500"));
  EXPECT_TRUE(std::isnan(c.tau[0])) << "where the solver's routine comes back";
}

TEST_F(LongFric, CompilesWithoutAWarningForEveryTableAndChoice) {
  for (const NamedTable& sample : sample_tables())
    for (const std::string choice : {"current", "start_of_increment"}) {
      if (choice != "current" && !has_every_kind_of_argument(sample)) continue;
      SCOPED_TRACE(sample.name + " " + choice);
      EXPECT_NO_THROW(routine("warnings " + sample.name + choice,
                              {sample.table, "m-kg-s", {}, {{"abaqus_coefficient", choice}}}));
    }
}

TEST_F(Fric, MayRunInThreadsAtOnce) {
  // Not with -fcheck=recursion: its own flag is shared by all threads.
  void* const function =
      Library::address(compiled("threads", *codegen::find_exporter("abaqus_fric"),
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
  const codegen::ExportRequest request{four_axis(), "m-kg-s", {}};
  const auto out =
      test::parse_json(codegen::find_exporter("abaqus_fric")->generate(request).at("recipe.json"));
  EXPECT_EQ(out["entry"], "fric");
  EXPECT_THAT(std::string(out["input_deck"]),
              testing::AllOf(testing::HasSubstr("*Friction, user, depvar=15, properties=3\n"
                                                " <surface expansion ratio A1/A0>, "
                                                "<flow stress of the workpiece, Pa>, 0.\n"),
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

} // namespace frictab::fric_test
