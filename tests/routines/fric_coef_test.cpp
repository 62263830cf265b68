// FRIC_COEF called as Abaqus/Standard calls it, by both argument lists, with bounds checked and
// floating point traps on: every trap of the interface that is known, by name.
#include <cmath>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "routines/standard_case.h"
#include "support/calls/fric_coef.h"
#include "support/generated.h"
#include "support/json.h"
#include "support/sample_tables.h"

namespace frictab::fric_coef_test {

using table::TableFunction;

namespace {

using calls::CoefCall;

using namespace test;

// By the argument list: "2024" or "2020".
class SlowFricCoef : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  }

  static bool newer() { return GetParam() == "2024"; }
  static void* routine(const std::string& key, codegen::ExportRequest request,
                       const std::vector<std::string>& flags = strict) {
    request.options["abaqus_release"] = GetParam();
    return codegen::Library::address(compiled(key + GetParam(),
                                              *codegen::find_exporter("abaqus_fric_coef"), request,
                                              "double", flags)
                                         ->handle(),
                                     "fric_coef_");
  }
  static void* four_axes() { return routine("four_axes", {four_axis(), "mm-t-s", {}}); }

  // 1000 MPa, 50 mm/s, 100 degC at every point; properties of the four-axis table.
  static CoefCall call(int points) {
    CoefCall c;
    c.release_2024 = newer();
    c.temperatures = true;
    c.properties = {psi, 60, flow};
    c.resize(points);
    for (std::size_t k = 0; k < static_cast<std::size_t>(points); ++k)
      set(c, k, 1000, 50, 100);
    return c;
  }
  static void set(CoefCall& c, std::size_t k, double pressure, double speed, double temperature) {
    c.pressure[k] = pressure;
    c.slip[k] = speed;
    c.temperature[k] = temperature;
  }
  static void run(CoefCall& c, void* function) {
    std::fill(c.coefficient.begin(), c.coefficient.end(), 777);
    std::fill(c.derivative.begin(), c.derivative.end(), 777);
    const FloatTraps traps;
    c.run(function);
  }
  // i from 1: slip rate, pressure, temperature, and with the newer list equivalent slip as 6.
  static double by(const CoefCall& c, std::size_t i, std::size_t k = 0) {
    return c.derivative[(i - 1) * static_cast<std::size_t>(c.points) + k];
  }
  static double tau(double pressure, double speed, double temperature) {
    static const TableFunction table(four_axis());
    const double state[] = {pressure, psi, speed, temperature, flow};
    return table(state);
  }
  static double mu(double pressure, double speed, double temperature) {
    return tau(pressure, speed, temperature) / pressure;
  }
};

TEST_P(SlowFricCoef, TakesBlocksOf0And1And136And512) {
  for (const int points : {0, 1, 136, 512}) {
    auto c = call(points);
    for (std::size_t k = 0; k < c.pressure.size(); ++k)
      set(c, k, 600 + 2.0 * double(k), 10 + double(k % 100), 50);
    run(c, four_axes());
    for (std::size_t k = 0; k < c.pressure.size(); ++k)
      EXPECT_CLOSE(c.coefficient[k], mu(c.pressure[k], c.slip[k], 50), 1e-13) << k;
  }
}

TEST_P(SlowFricCoef, LeavesTheSecondCoefficientOfIsotropicFrictionAlone) {
  auto c = call(3);
  run(c, four_axes());
  for (std::size_t k = 3; k < c.coefficient.size(); ++k)
    EXPECT_EQ(c.coefficient[k], 777);
  for (std::size_t i = 0; i < c.derivative.size(); ++i)
    if (i < 60)
      EXPECT_NE(c.derivative[i], 777) << i;
    else
      EXPECT_EQ(c.derivative[i], 777) << i;
}

TEST_P(SlowFricCoef, DerivativesAreThoseOfItsOwnDifferences) {
  for (const double pressure : {300.0, 800.0, 2200.0, 9000.0})
    for (const double speed : {1.0, 30.0, 300.0})
      for (const double temperature : {10.0, 60.0, 150.0}) {
        const auto differ = [&](auto&& number, double step) {
          auto up = call(1), down = call(1);
          for (CoefCall* c : {&up, &down})
            set(*c, 0, pressure, speed, temperature);
          number(up) += step;
          number(down) -= step;
          run(up, four_axes());
          run(down, four_axes());
          return (up.coefficient[0] - down.coefficient[0]) / (2 * step);
        };
        auto c = call(1);
        set(c, 0, pressure, speed, temperature);
        run(c, four_axes());
        // What the third derivative and rounding leave of coefficients near 0.1.
        EXPECT_NEAR(by(c, 1), differ([](CoefCall& d) -> double& { return d.slip[0]; }, 1e-4), 1e-9);
        EXPECT_NEAR(by(c, 2), differ([](CoefCall& d) -> double& { return d.pressure[0]; }, 1e-3),
                    1e-10);
        EXPECT_NEAR(by(c, 3), differ([](CoefCall& d) -> double& { return d.temperature[0]; }, 1e-3),
                    1e-10);
      }
}

TEST_P(SlowFricCoef, GivesTheShearLimitAsACoefficientThatFallsWithPressure) {
  auto c = call(1);
  set(c, 0, 9000, 50, 100);
  run(c, four_axes());
  EXPECT_CLOSE(c.coefficient[0] * 9000, 0.8 * 0.5773502691896258 * flow, 1e-13);
  EXPECT_CLOSE(by(c, 2), -c.coefficient[0] / 9000, 1e-13);
}

TEST_P(SlowFricCoef, HoldsTheCoefficientBelowTheSmallestPressureAndWithoutAny) {
  const table::Table table = one_axis_table(); // tau_R by psi alone: tau_R/p has no limit
  static const TableFunction function(table);
  const double state[] = {psi};
  for (const double pressure : {0.5, 0.0, -50.0}) {
    auto c = call(1);
    c.properties = {psi};
    c.pressure[0] = pressure;
    run(c, routine("one_axis", {table, "mm-t-s", {}}));
    EXPECT_GT(function(state), 10) << "at 1 MPa";
    EXPECT_EQ(c.coefficient[0], 10) << "the most that a solver gets";
    EXPECT_EQ(by(c, 2), 0);
  }
}

TEST_P(SlowFricCoef, HasNoDerivativesWhereTheCoefficientIsCut) {
  const table::Table table = one_axis_table();
  auto c = call(1);
  c.properties = {psi};
  c.pressure[0] = 2;
  run(c, routine("one_axis", {table, "mm-t-s", {}}));
  EXPECT_EQ(c.coefficient[0], 10);
  for (std::size_t i = 1; i <= 3; ++i)
    EXPECT_EQ(by(c, i), 0);
  c.pressure[0] = 100;
  run(c, routine("one_axis", {table, "mm-t-s", {}}));
  EXPECT_LT(c.coefficient[0], 10);
  EXPECT_LT(by(c, 2), 0);
}

TEST_P(SlowFricCoef, DoesNotStopForAPointThatDoesNotPress) {
  table::Table table = sides_table();
  table.axes[0].below = table::Outside::error; // pressure
  auto c = call(2);
  c.properties = {60, flow};
  c.pressure[0] = 0;
  run(c, routine("refusing", {table, "mm-t-s", {}}));
  EXPECT_GT(c.coefficient[0], 0) << "that of the nearest end";
  for (std::size_t i = 1; i <= 3; ++i)
    EXPECT_EQ(by(c, i), 0);
  EXPECT_GT(c.coefficient[1], 0);
  c.pressure[0] = 100;
  run(c, routine("refusing", {table, "mm-t-s", {}}));
  EXPECT_TRUE(std::isnan(c.coefficient[0])) << "where the solver's routine comes back";
}

TEST_P(SlowFricCoef, TakesTheReferenceTemperatureWhereTheModelHasNone) {
  auto c = call(2);
  c.temperatures = false;
  std::fill(c.temperature.begin(), c.temperature.end(), nan);
  run(c, four_axes());
  EXPECT_CLOSE(c.coefficient[1], mu(1000, 50, 60), 1e-13);
  EXPECT_EQ(by(c, 3), 0);
}

TEST_P(SlowFricCoef, GivesNaNForNaNInAnyArgumentItUses) {
  using Spoil = void (*)(CoefCall&);
  const std::pair<const char*, Spoil> spoils[] = {
      {"pressure", [](CoefCall& c) { c.pressure[1] = nan; }},
      {"slip rate", [](CoefCall& c) { c.slip[1] = nan; }},
      {"tempAvg", [](CoefCall& c) { c.temperature[1] = nan; }},
      {"props", [](CoefCall& c) { c.properties[2] = nan; }}};
  for (const auto& [name, spoil] : spoils) {
    auto c = call(3);
    spoil(c);
    run(c, four_axes());
    EXPECT_TRUE(std::isnan(c.coefficient[1])) << name;
    for (std::size_t i = 1; i <= 3; ++i)
      EXPECT_EQ(by(c, i, 1), 0) << name;
    if (std::string(name) != "props") {
      EXPECT_CLOSE(c.coefficient[2], mu(1000, 50, 100), 1e-13);
    }
  }
}

TEST_P(SlowFricCoef, TakesInfinitiesAsFarOutsideTheTable) {
  auto c = call(4);
  c.pressure[0] = inf; // beyond the shear limit, whose coefficient vanishes
  c.slip[1] = inf;
  c.temperature[2] = -inf;
  c.pressure[3] = -inf;
  run(c, four_axes());
  EXPECT_NEAR(c.coefficient[0], 0, 1e-20);
  EXPECT_CLOSE(c.coefficient[1], mu(1000, 1e9, 100), 1e-13);
  EXPECT_CLOSE(c.coefficient[2], mu(1000, 50, -1e9), 1e-13);
  EXPECT_CLOSE(c.coefficient[3], mu(1, 50, 100), 1e-13);
}

TEST_P(SlowFricCoef, UsesTheNearestEdgeOutsideEachSideOfEachAxis) {
  const double states[][3] = {{100, 50, 100},    {4000, 50, 100}, {1000, 1, 100},
                              {1000, 2000, 100}, {1000, 50, -40}, {1000, 50, 900}};
  auto c = call(6);
  for (std::size_t k = 0; k < 6; ++k)
    set(c, k, states[k][0], states[k][1], states[k][2]);
  run(c, four_axes());
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_CLOSE(c.coefficient[k], mu(states[k][0], states[k][1], states[k][2]), 1e-13);
}

TEST_P(SlowFricCoef, TakesStatesFromFieldsAndConstantsAsTheJobSays) {
  static const TableFunction table(four_axis());
  void* const function =
      routine("fields",
              {four_axis(),
               "mm-t-s",
               {{"psi", "field:2"}, {"sigma_f_MPa", "constant:300"}, {"T_contact_C", "field:1"}}});
  auto c = call(1);
  c.properties.clear();
  c.fields = 2;
  c.resize(2);
  for (std::size_t k = 0; k < 2; ++k)
    set(c, k, 1000, 50, nan);
  c.field = {60, 100, 4, 7};
  run(c, function);
  const double first[] = {1000, 4, 50, 60, 300}, second[] = {1000, 7, 50, 100, 300};
  EXPECT_CLOSE(c.coefficient[0], table(first) / 1000, 1e-13);
  EXPECT_CLOSE(c.coefficient[1], table(second) / 1000, 1e-13);
  c.fields = 1; // field 2 is not there: the middle of the axis
  run(c, function);
  const double fallback[] = {1000, std::sqrt(20.0), 50, 60, 300};
  EXPECT_CLOSE(c.coefficient[0], table(fallback) / 1000, 1e-13);
}

TEST_P(SlowFricCoef, TakesTypicalValuesForPropertiesTheDeckDoesNotGive) {
  static const TableFunction table(four_axis());
  auto c = call(1);
  c.properties.clear();
  run(c, four_axes());
  const double state[] = {1000, std::sqrt(20.0), 50, 100, 480};
  EXPECT_CLOSE(c.coefficient[0], table(state) / 1000, 1e-13);
}

TEST_P(SlowFricCoef, ConvertsUnitsOfMetreKilogramSecondAndTheirDerivatives) {
  auto c = call(1), metre = call(1);
  metre.properties = {psi, 60, flow * 1e6};
  set(metre, 0, 1000e6, 0.05, 100);
  run(c, four_axes());
  run(metre, routine("si", {four_axis(), "m-kg-s", {}}));
  EXPECT_CLOSE(metre.coefficient[0], c.coefficient[0], 1e-13);
  EXPECT_NEAR(by(metre, 1), by(c, 1) * 1e3, 1e-12);
  EXPECT_NEAR(by(metre, 2), by(c, 2) * 1e-6, 1e-20);
  EXPECT_NEAR(by(metre, 3), by(c, 3), 1e-15);
}

TEST_P(SlowFricCoef, CompilesWithoutAWarningForEveryTable) {
  for (const NamedTable& sample : sample_tables()) {
    if (!newer() && !has_every_kind_of_argument(sample)) continue;
    SCOPED_TRACE(sample.name);
    EXPECT_NO_THROW(routine("warnings " + sample.name, {sample.table, "m-kg-s", {}}));
  }
}

TEST_P(SlowFricCoef, AgreesWithFrictabItselfBySlippingBlocks) {
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_fric_coef");
  for (const NamedTable& sample : sample_tables()) { // SlowAgreement has all of them
    if (!has_every_kind_of_argument(sample)) continue;
    SCOPED_TRACE(sample.name);
    const codegen::ExportRequest request{
        sample.table, "mm-t-s", {}, {{"abaqus_release", GetParam()}}};
    const States states(request.table, 2000, 12, 0.1);
    std::vector<double> found(states.rows(), -1);
    codegen::CompiledTarget(exporter, request, exporter.generate(request),
                            exporter.variants(request)[0])
        .drive(states.rows(), states.columns(), found);
    EXPECT_LE(worst_relative(found, expected(request.table, states)), 1e-13);
  }
}

TEST_P(SlowFricCoef, MayRunInThreadsAtOnce) {
  // Not with -fcheck=recursion: its own flag is shared by all threads.
  void* const function = routine("threads", {four_axis(), "mm-t-s", {}}, {"-O2"});
  auto reference = call(136);
  for (std::size_t k = 0; k < 136; ++k)
    set(reference, k, 600 + 10 * double(k), 10 + double(k), 50);
  auto serial = reference;
  serial.run(function);
  std::vector<CoefCall> calls(4, reference);
  std::vector<std::thread> threads;
  for (CoefCall& c : calls)
    threads.emplace_back([&c, &reference, function] {
      for (int i = 0; i < 200; ++i) {
        c = reference;
        c.run(function);
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  for (const CoefCall& c : calls) {
    EXPECT_EQ(c.coefficient, serial.coefficient);
    EXPECT_EQ(c.derivative, serial.derivative);
  }
}

INSTANTIATE_TEST_SUITE_P(Releases, SlowFricCoef, testing::Values("2024", "2020"),
                         [](const auto& given) { return given.param; });

TEST(FricCoefRecipe, SaysTheReleaseAndRefusesToKeepACoefficientWithoutStateVariables) {
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_fric_coef");
  for (const std::string release : {"2024", "2020"}) {
    const codegen::ExportRequest request{four_axis(), "mm-t-s", {}, {{"abaqus_release", release}}};
    const codegen::SourceBundle files = exporter.generate(request);
    const auto out = test::parse_json(files.at("recipe.json"));
    EXPECT_EQ(out["options"]["abaqus_release"], release);
    EXPECT_EQ(out["state_variables"].size(), release == "2024" ? 11U : 0U);
    EXPECT_THAT(std::string(out["input_deck"]),
                testing::HasSubstr(release == "2024" ? "user=COEFFICIENT, depvar=11, properties=3\n"
                                                     : "user=COEFFICIENT, properties=3\n"));
    EXPECT_THAT(files.at("frictab_fric_coef.f"),
                testing::HasSubstr("ARGUMENT LIST OF RELEASE " + release));
  }
  try {
    exporter.generate({four_axis(),
                       "mm-t-s",
                       {},
                       {{"abaqus_release", "2020"}, {"abaqus_coefficient", "start_of_increment"}}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("has no state variables"));
  }
}

} // namespace

} // namespace frictab::fric_coef_test
