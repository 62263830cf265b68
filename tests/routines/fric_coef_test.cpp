// FRIC_COEF called as Abaqus/Standard calls it, by both argument lists, with bounds checked and
// floating point traps on: what explicit_routines_test.cpp does not ask of all routines.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "routines/abaqus_routines.h"
#include "support/json.h"
#include "support/sample_tables.h"

namespace frictab::fric_coef_test {

using table::TableFunction;

namespace {

using calls::CoefCall;

using namespace test;

using Case = CoefficientCase<CoefCall>;

// By the argument list: "2024" or "2020".
class LongFricCoef : public NeedsGfortran,
                     public testing::WithParamInterface<std::string>,
                     protected Case {
protected:
  LongFricCoef() : Case(GetParam()) {}
  static double mu(double pressure, double speed, double temperature) {
    return tau(pressure, speed, temperature) / pressure;
  }
};

TEST_P(LongFricCoef, LeavesTheSecondCoefficientOfIsotropicFrictionAlone) {
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

TEST_P(LongFricCoef, DerivativesAreThoseOfItsOwnDifferences) {
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

TEST_P(LongFricCoef, GivesTheShearLimitAsACoefficientThatFallsWithPressure) {
  auto c = call(1);
  set(c, 0, 9000, 50, 100);
  run(c, four_axes());
  EXPECT_CLOSE(c.coefficient[0] * 9000, 0.8 * 0.5773502691896258 * flow, 1e-13);
  EXPECT_CLOSE(by(c, 2), -c.coefficient[0] / 9000, 1e-13);
}

TEST_P(LongFricCoef, HoldsTheCoefficientBelowTheSmallestPressureAndWithoutAny) {
  const table::Table table = one_axis_table(); // tau_R by psi alone: tau_R/p has no limit
  static const TableFunction function(table);
  const double state[] = {psi};
  for (const double pressure : {0.5, 0.0, -50.0}) {
    auto c = call(1);
    c.properties = {psi};
    c.pressure[0] = pressure;
    run(c, routine("one_axis", table));
    EXPECT_GT(function(state), 10) << "at 1 MPa";
    EXPECT_EQ(c.coefficient[0], 10) << "the most that a solver gets";
    EXPECT_EQ(by(c, 2), 0);
  }
}

TEST_P(LongFricCoef, HasNoDerivativesWhereTheCoefficientIsCut) {
  const table::Table table = one_axis_table();
  auto c = call(1);
  c.properties = {psi};
  c.pressure[0] = 2;
  run(c, routine("one_axis", table));
  EXPECT_EQ(c.coefficient[0], 10);
  for (std::size_t i = 1; i <= 3; ++i)
    EXPECT_EQ(by(c, i), 0);
  c.pressure[0] = 100;
  run(c, routine("one_axis", table));
  EXPECT_LT(c.coefficient[0], 10);
  EXPECT_LT(by(c, 2), 0);
}

TEST_P(LongFricCoef, DoesNotStopForAPointThatDoesNotPress) {
  table::Table table = sides_table();
  table.axes[0].below = table::Outside::error; // pressure
  auto c = call(2);
  c.properties = {60, flow};
  c.pressure[0] = 0;
  run(c, routine("refusing", table));
  EXPECT_GT(c.coefficient[0], 0) << "that of the nearest end";
  for (std::size_t i = 1; i <= 3; ++i)
    EXPECT_EQ(by(c, i), 0);
  EXPECT_GT(c.coefficient[1], 0);
  c.pressure[0] = 100;
  run(c, routine("refusing", table));
  EXPECT_TRUE(std::isnan(c.coefficient[0])) << "where the solver's routine comes back";
}

TEST_P(LongFricCoef, TakesAPullAsTheSmallestPressureHoweverStrongItIs) {
  auto c = call(1);
  c.pressure[0] = -inf;
  run(c, four_axes());
  EXPECT_CLOSE(c.coefficient[0], mu(1, 50, 100), 1e-13);
}

TEST_P(LongFricCoef, TakesStatesFromFieldsAndConstantsAsTheJobSays) {
  expect_states_from_fields_and_constants(static_cast<const Case&>(*this));
}

TEST_P(LongFricCoef, ConvertsUnitsOfMetreKilogramSecondAndTheirDerivatives) {
  auto c = call(1), metre = call(1);
  metre.properties = {psi, 60, flow * 1e6};
  set(metre, 0, 1000e6, 0.05, 100);
  run(c, four_axes());
  run(metre, routine("si", four_axis(), {}, "m-kg-s"));
  EXPECT_CLOSE(metre.coefficient[0], c.coefficient[0], 1e-13);
  EXPECT_NEAR(by(metre, 1), by(c, 1) * 1e3, 1e-12);
  EXPECT_NEAR(by(metre, 2), by(c, 2) * 1e-6, 1e-20);
  EXPECT_NEAR(by(metre, 3), by(c, 3), 1e-15);
}

TEST_P(LongFricCoef, CompilesWithoutAWarningForEveryTable) {
  for (const NamedTable& sample : sample_tables()) {
    if (!is_newer() && !has_every_kind_of_argument(sample)) continue;
    SCOPED_TRACE(sample.name);
    EXPECT_NO_THROW(routine("warnings " + sample.name, sample.table, {}, "m-kg-s"));
  }
}

TEST_P(LongFricCoef, AgreesWithFrictabItselfBySlippingBlocks) {
  const codegen::Exporter& exporter = *codegen::find_exporter("abaqus_fric_coef");
  for (const NamedTable& sample : sample_tables()) { // LongAgreement has all of them
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

INSTANTIATE_TEST_SUITE_P(Releases, LongFricCoef, testing::Values("2024", "2020"),
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
  const codegen::ExportRequest kept{
      four_axis(),
      "mm-t-s",
      {},
      {{"abaqus_release", "2020"}, {"abaqus_coefficient", "start_of_increment"}}};
  EXPECT_THAT(refusal([&] { exporter.generate(kept); }),
              testing::HasSubstr("has no state variables"));
}

} // namespace

} // namespace frictab::fric_coef_test
