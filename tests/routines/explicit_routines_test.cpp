// VFRIC, VFRICTION, VFRIC_COEF and FRIC_COEF called as Abaqus calls them (VFRIC_COEF through the
// argument list that is recalled for it), in the precisions of their solvers, with bounds checked
// and floating point traps on: every trap of the interfaces that is known, by name. What a routine
// has no use for is NaN.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "routines/abaqus_routines.h"

namespace frictab::explicit_routines_test {

using table::Table;
using table::TableFunction;
using namespace test;

namespace {

template <class Real> using VfricCoefCase = CoefficientCase<calls::VfricCoefCall<Real>>;
using FricCoef2024 = CoefficientCase<calls::CoefCall>;
struct FricCoef2020 : FricCoef2024 {
  FricCoef2020() : FricCoef2024("2020") {}
};

template <class Case> struct ExplicitRoutine : NeedsGfortran, Case {};
// ---- what holds for all ----

template <class Case> using ExplicitRoutines = ExplicitRoutine<Case>;
TYPED_TEST_SUITE_P(ExplicitRoutines);

TYPED_TEST_P(ExplicitRoutines, TakeBlocksOf0And1And136And512) {
  for (const int points : {0, 1, 136, 512}) {
    auto c = this->call(points);
    const auto n = static_cast<std::size_t>(points);
    for (std::size_t k = 0; k < n; ++k)
      this->set(c, k, 600 + 2.0 * double(k), 10 + double(k % 100), 50);
    this->run(c, this->four_axes());
    for (std::size_t k = 0; k < n; ++k)
      EXPECT_CLOSE(this->stress(c, k), this->tau(600 + 2.0 * double(k), 10 + double(k % 100), 50),
                   this->bound);
  }
}

TYPED_TEST_P(ExplicitRoutines, TakeTheReferenceTemperatureWhereTheModelHasNone) {
  auto c = this->call(2);
  this->forget_temperatures(c);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 2; ++k)
    EXPECT_CLOSE(this->stress(c, k), this->tau(1000, 50, 60), this->bound);
  if constexpr (TypeParam::gives_coefficient) {
    EXPECT_EQ(this->by(c, 3), 0);
  }
}

TYPED_TEST_P(ExplicitRoutines, GiveNaNForNaNInAnyArgumentTheyUseAndKeepThatState) {
  for (const auto& [name, spoil] : this->spoils()) {
    auto c = this->call(3);
    spoil(c);
    this->run(c, this->four_axes());
    EXPECT_TRUE(std::isnan(this->answer(c, 1))) << name;
    this->expect_kept(c, name);
    if (!name.starts_with("global")) {
      EXPECT_CLOSE(this->stress(c, 2), this->tau(1000, 50, 100), this->bound);
    }
  }
}

TYPED_TEST_P(ExplicitRoutines, TakeInfinitiesAsFarOutsideTheTable) {
  auto c = this->call(3);
  this->set(c, 0, inf, 50, 100); // beyond the shear limit
  this->set(c, 1, 1000, inf, 100);
  this->set(c, 2, 1000, 50, -inf);
  this->run(c, this->four_axes());
  if (TypeParam::gives_coefficient) {
    EXPECT_NEAR(this->answer(c, 0), 0, 1e-20); // a finite stress over it
  } else {
    EXPECT_CLOSE(this->stress(c, 0), 0.8 * 0.5773502691896258 * flow, this->bound);
  }
  EXPECT_CLOSE(this->stress(c, 1), this->tau(1000, 1e9, 100), this->bound);
  EXPECT_CLOSE(this->stress(c, 2), this->tau(1000, 50, -1e9), this->bound);
}

TYPED_TEST_P(ExplicitRoutines, UseTheNearestEdgeOutsideEachSideOfEachAxisAndCountIt) {
  const double states[][3] = {{100, 50, 100},  {4000, 50, 100}, {1000, 1, 100}, {1000, 2000, 100},
                              {1000, 50, -40}, {1000, 50, 900}, {1000, 50, 100}};
  auto c = this->call(7);
  for (std::size_t k = 0; k < 7; ++k)
    this->set(c, k, states[k][0], states[k][1], states[k][2]);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_CLOSE(this->stress(c, k), this->tau(states[k][0], states[k][1], states[k][2]),
                 this->bound);
    if constexpr (!TypeParam::gives_coefficient)
      if (c.states > 3) {
        EXPECT_EQ(c.state[6 * k + 3], k < 6 ? 1 : 0);
      }
  }
}

TYPED_TEST_P(ExplicitRoutines, TakeTypicalValuesForPropertiesTheDeckDoesNotGive) {
  auto c = this->call(1);
  c.properties.clear();
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->stress(c), four_axis_tau(1000, 50, 100, std::sqrt(20.0)), this->bound);
}

TYPED_TEST_P(ExplicitRoutines, ConvertUnitsOfMetreKilogramSecond) {
  using Number = typename TypeParam::Real;
  auto c = this->call(2);
  c.properties = {Number(psi), Number(60), Number(480e6)};
  this->set(c, 0, 1000e6, 0.05, 100);
  this->set(c, 1, 0, 0.05, 100);
  this->run(c, this->routine("si", four_axis(), {}, "m-kg-s"));
  EXPECT_CLOSE(this->stress(c), this->tau(1000, 50, 100) * 1e6, this->bound);
  if (TypeParam::gives_coefficient) {
    EXPECT_CLOSE(this->answer(c, 1), this->tau(500, 50, 100) / 500, this->bound);
  }
}

TYPED_TEST_P(ExplicitRoutines, MayRunInThreadsAtOnce) {
  auto c = this->call(136);
  for (std::size_t k = 0; k < 136; ++k)
    this->set(c, k, 600 + 10 * double(k), 10 + double(k), 50);
  expect_the_same_in_threads(c, this->routine("threads", four_axis(), {}, "mm-t-s", {"-O2"}),
                             TypeParam::outputs);
}

REGISTER_TYPED_TEST_SUITE_P(ExplicitRoutines, TakeBlocksOf0And1And136And512,
                            TakeTheReferenceTemperatureWhereTheModelHasNone,
                            GiveNaNForNaNInAnyArgumentTheyUseAndKeepThatState,
                            TakeInfinitiesAsFarOutsideTheTable,
                            UseTheNearestEdgeOutsideEachSideOfEachAxisAndCountIt,
                            TakeTypicalValuesForPropertiesTheDeckDoesNotGive,
                            ConvertUnitsOfMetreKilogramSecond, MayRunInThreadsAtOnce);
using Quick = testing::Types<VfricCase<double>, VfricCase<float>>;
using Slow = testing::Types<VfrictionCase<double>, VfrictionCase<float>, VfricCoefCase<double>,
                            VfricCoefCase<float>, FricCoef2024, FricCoef2020>;
INSTANTIATE_TYPED_TEST_SUITE_P(Abaqus, ExplicitRoutines, Quick, RoutineName);
INSTANTIATE_TYPED_TEST_SUITE_P(SlowAbaqus, ExplicitRoutines, Slow, RoutineName);

// ---- of forces ----

template <class Case> using ExplicitForces = ExplicitRoutine<Case>;
TYPED_TEST_SUITE_P(ExplicitForces);

TYPED_TEST_P(ExplicitForces, TakeTwoDimensionsWithoutTouchingAThirdComponent) {
  auto c = this->call(3, [](auto& plain) { plain.directions = 2; });
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_CLOSE(this->stress(c, k), this->tau(1000, 50, 100), this->bound);
}

TYPED_TEST_P(ExplicitForces, TakeThreeDimensionsAndLeaveTheSecondTangentZero) {
  using Number = typename TypeParam::Real;
  auto c = this->call(2);
  const Number part = c.slip[0];
  c.slip[0] = part * Number(0.6); // the same speed, along two axes
  c.slip[1] = part * Number(0.8);
  this->run(c, this->four_axes());
  const double tau = this->tau(1000, 50, 100);
  EXPECT_NEAR(this->stress(c), tau, 1e-5 * tau);
  EXPECT_EQ(c.tangential[1], 0);
  EXPECT_EQ(c.tangential[3], 0);
}

TYPED_TEST_P(ExplicitForces, TakeAnAnalyticalRigidMainSurface) {
  auto c = this->call(4, [](auto& plain) { plain.rigid = true; });
  c.temperature_main[0] = 140;
  for (std::size_t k = 0; k < 4; ++k)
    this->set(c, k, 1000, 50, 60);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_CLOSE(this->stress(c, k), this->tau(1000, 50, 100), this->bound);
}

TYPED_TEST_P(ExplicitForces, TakeTheFirstIncrementWithoutDividingByItsZeroTime) {
  auto c = this->call(2);
  c.time_increment = 0;
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->stress(c), this->tau(1000, 0, 100), this->bound);
}

TYPED_TEST_P(ExplicitForces, AreZeroWithoutAreaOrNormalForceAndKeepTheState) {
  auto c = this->call(4);
  c.area = {0, -1, 1, 1};
  c.normal = {100, 100, 0, -50};
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(this->answer(c, k), 0);
  EXPECT_EQ(c.state, std::vector<typename TypeParam::Real>(c.state.size()));
}

TYPED_TEST_P(ExplicitForces, TakeStatesFromFieldsAndConstantsAsTheJobSays) {
  expect_states_from_fields_and_constants(static_cast<const TypeParam&>(*this));
}

REGISTER_TYPED_TEST_SUITE_P(ExplicitForces, TakeTwoDimensionsWithoutTouchingAThirdComponent,
                            TakeThreeDimensionsAndLeaveTheSecondTangentZero,
                            TakeAnAnalyticalRigidMainSurface,
                            TakeTheFirstIncrementWithoutDividingByItsZeroTime,
                            AreZeroWithoutAreaOrNormalForceAndKeepTheState,
                            TakeStatesFromFieldsAndConstantsAsTheJobSays);
using SlowForces = testing::Types<VfrictionCase<double>, VfrictionCase<float>>;
INSTANTIATE_TYPED_TEST_SUITE_P(Abaqus, ExplicitForces, Quick, RoutineName);
INSTANTIATE_TYPED_TEST_SUITE_P(SlowAbaqus, ExplicitForces, SlowForces, RoutineName);

// ---- of one routine ----

using Precisions = testing::Types<double, float>;
struct PrecisionName {
  template <class Real> static std::string GetName(int) {
    return sizeof(Real) == 4 ? "single" : "double";
  }
};

template <class Real> using Vfric = ExplicitRoutine<VfricCase<Real>>;
TYPED_TEST_SUITE(Vfric, Precisions, PrecisionName);

TYPED_TEST(Vfric, FollowsAPermutedContactToNodeMapForAreaAndState) {
  auto c = this->call(3);
  c.resize(3, 5);
  c.node = {5, 1, 3};
  c.area = {2, 0.5, 4, 0.25, 8};
  for (std::size_t k = 0; k < 3; ++k)
    this->set(c, k, 800 + 100 * double(k), 20, 90);
  this->run(c, this->four_axes());
  const double area[] = {8, 2, 4};
  for (std::size_t k = 0; k < 3; ++k) {
    const double pressure = 800 + 100 * double(k);
    EXPECT_CLOSE(this->answer(c, k), -this->tau(pressure, 20, 90) * area[k], this->bound);
    const std::size_t node = static_cast<std::size_t>(c.node[k]) - 1;
    EXPECT_EQ(c.state[3 * node], c.slip[3 * k]);
    EXPECT_EQ(c.state[3 * node + 2], TypeParam(pressure));
  }
  EXPECT_EQ(c.state[3 * 1], 0); // nodes that are not in contact
  EXPECT_EQ(c.state[3 * 3], 0);
}

TYPED_TEST(Vfric, GivesNaNForANaNSlipHistory) {
  auto c = this->call(2);
  c.properties = {TypeParam(flow)};
  c.state[3] = TypeParam(nan);
  this->run(c, this->branching());
  EXPECT_FALSE(std::isnan(this->answer(c, 0)));
  EXPECT_TRUE(std::isnan(this->answer(c, 1)));
}

TYPED_TEST(Vfric, WritesNoStateBeyondDEPVAR) {
  for (const int states : {0, 1, 2, 3, 5}) {
    auto c = this->call(1);
    c.states = states;
    c.resize(2, 2);
    for (std::size_t k = 0; k < 2; ++k)
      this->set(c, k, 1000, 50, 100);
    this->run(c, this->four_axes());
    EXPECT_CLOSE(this->answer(c, 1), -this->tau(1000, 50, 100), this->bound);
    for (std::size_t i = 3; i < static_cast<std::size_t>(states); ++i)
      EXPECT_EQ(c.state[i], 0);
  }
}

TYPED_TEST(Vfric, CountsIncrementsInWhichAHeldInputIsOutsideWhatWasTested) {
  static const Table table = held_inputs_table();
  auto c = this->call(1);
  c.states = 6;
  c.resize(1, 1);
  this->set(c, 0, 1000, 50, 100);
  for (const double humidity : {45.0, 29.0, 61.0}) {
    c.properties = {TypeParam(humidity)};
    this->run(c, this->routine("held", table));
  }
  EXPECT_EQ(c.state[3], 2);
}

TYPED_TEST(Vfric, TakesTheIncrementsSlipAloneWithoutStateVariables) {
  auto c = this->call(1);
  c.properties = {TypeParam(flow)};
  c.states = 0;
  c.resize(1, 1);
  this->set(c, 0, 300, 20, 0);
  this->run(c, this->branching());
  EXPECT_CLOSE(this->answer(c), -branching_tau(300, 20, double(c.slip[0])), this->bound);
}

TYPED_TEST(Vfric, AddsSlipBeforeEvaluatingAndOncePerCall) {
  auto c = this->call(1);
  c.properties = {TypeParam(flow)};
  c.time_increment = TypeParam(0.125);
  this->set(c, 0, 300, 40, 0); // 5 mm
  for (int increment = 1; increment <= 3; ++increment) {
    this->run(c, this->branching());
    EXPECT_EQ(c.state[0], TypeParam(5 * increment));
    EXPECT_CLOSE(this->answer(c), -branching_tau(300, 40, 5.0 * increment), this->bound);
  }
}

TYPED_TEST(Vfric, AddsFrictionWorkPerAreaAndKeepsThePeakPressure) {
  auto c = this->call(1);
  c.area[0] = 4;
  c.previous = {TypeParam(-80), 0, 0};
  this->set(c, 0, 1000, 50, 100);
  this->run(c, this->four_axes());
  const double work = 0.5 * (80 + this->tau(1000, 50, 100) * 4) / 4 * double(c.slip[0]);
  EXPECT_CLOSE(double(c.state[1]), work, this->bound);
  this->set(c, 0, 700, 50, 100);
  this->run(c, this->four_axes());
  EXPECT_EQ(c.state[2], 1000);
}

TYPED_TEST(Vfric, GivesNaNWhereAMissingPropertyHasNoTypicalValue) {
  auto c = this->call(1);
  c.properties.clear();
  this->run(c, this->branching());
  EXPECT_TRUE(std::isnan(this->answer(c)));
}

template <class Real> using SlowVfriction = ExplicitRoutine<VfrictionCase<Real>>;
TYPED_TEST_SUITE(SlowVfriction, Precisions, PrecisionName);

TYPED_TEST(SlowVfriction, WritesNothingWithoutAFrictionDirection) {
  auto c = this->call(2, [](auto& plain) { plain.directions = 1; });
  this->run(c, this->four_axes());
  EXPECT_TRUE(c.tangential.empty());
  EXPECT_EQ(c.state[0], c.slip[0]);
}

TYPED_TEST(SlowVfriction, TakesAreaAndStateByContactPoint) {
  auto c = this->call(3);
  c.area = {8, 2, 4};
  for (std::size_t k = 0; k < 3; ++k)
    this->set(c, k, 800 + 100 * double(k), 20, 90);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 3; ++k) {
    const double pressure = 800 + 100 * double(k);
    EXPECT_CLOSE(this->answer(c, k), -this->tau(pressure, 20, 90) * double(c.area[k]), this->bound);
    EXPECT_EQ(c.state[6 * k], c.slip[3 * k]);
    EXPECT_EQ(c.state[6 * k + 2], TypeParam(pressure));
  }
}

TYPED_TEST(SlowVfriction, AdvancesAllColumnsOfAnEdgeAlikeAndUsesTheirMean) {
  auto c = this->call(2, [](auto& plain) { plain.edges = true; });
  c.properties = {TypeParam(flow)};
  for (std::size_t k = 0; k < 2; ++k)
    this->set(c, k, 300, 20, 0);
  for (std::size_t j = 0; j < 4; ++j)
    c.state[6 * (4 + j)] = TypeParam(2 * j); // second point: 0, 2, 4, 6 mm
  this->run(c, this->branching());
  const double slip = double(c.slip[0]);
  EXPECT_CLOSE(this->answer(c, 0), -branching_tau(300, 20, slip), this->bound);
  EXPECT_CLOSE(this->answer(c, 1), -branching_tau(300, 20, 3 + slip), this->bound);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_EQ(c.state[6 * j], TypeParam(slip));
    EXPECT_NEAR(c.state[6 * (4 + j)] + c.state[6 * (4 + j) + 4], 2 * double(j) + slip, 1e-12);
    EXPECT_EQ(c.state[6 * j + 2], 300);
    EXPECT_GT(c.state[6 * j + 1], 0);
  }
}

TYPED_TEST(SlowVfriction, WritesNoStateBeyondDEPVAR) {
  for (int states = 0; states <= 10; ++states)
    for (const bool edges : {false, true}) {
      auto c = this->call(1);
      c.states = states;
      c.edges = edges;
      c.resize(2);
      for (std::size_t k = 0; k < 2; ++k)
        this->set(c, k, 1000, 50, 100);
      this->run(c, this->four_axes());
      EXPECT_CLOSE(this->answer(c, 1), -this->tau(1000, 50, 100), this->bound);
      for (int i = 8; i < states; ++i)
        EXPECT_EQ(c.state[static_cast<std::size_t>(i)], 0);
      if (states >= 8) {
        EXPECT_CLOSE(c.state[6], this->tau(1000, 50, 100), this->bound);
        EXPECT_CLOSE(c.state[7], this->tau(1000, 50, 100) / 1000, this->bound);
      }
      if (states > 0) {
        EXPECT_EQ(c.state[0], c.slip[0]);
      }
    }
}

TYPED_TEST(SlowVfriction, TakesFieldsOfAnAnalyticalRigidMainSurface) {
  void* function = this->routine("field_rigid", four_axis(), {{"T_contact_C", "field:1"}});
  auto c = this->call(1);
  c.properties = {TypeParam(psi), TypeParam(flow)};
  c.fields = 1;
  c.rigid = true;
  c.resize(3);
  for (std::size_t k = 0; k < 3; ++k)
    this->set(c, k, 1000, 50, 0);
  c.field = {80, 90, 100};
  c.field_main = {40};
  this->run(c, function);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_CLOSE(this->answer(c, k), -this->tau(1000, 50, 60 + 5 * double(k)), this->bound);
}

template <class Real> using SlowVfricCoef = ExplicitRoutine<VfricCoefCase<Real>>;
TYPED_TEST_SUITE(SlowVfricCoef, Precisions, PrecisionName);

TYPED_TEST(SlowVfricCoef, SetsAllThreeDerivativesToZero) {
  auto c = this->call(5);
  this->run(c, this->four_axes());
  EXPECT_EQ(c.derivative, std::vector<TypeParam>(15));
}

TYPED_TEST(SlowVfricCoef, IsTheLimitWhereThereIsNoPressureToDivideBy) {
  auto c = this->call(4);
  c.pressure = {TypeParam(0), TypeParam(1e-30), TypeParam(-5), TypeParam(1e-3)};
  this->run(c, this->four_axes());
  // tau = mu p with mu at the nearest edge, 500 MPa: the limit is mu.
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_CLOSE(c.coefficient[k], this->tau(500, 50, 100) / 500, this->bound);
}

TYPED_TEST(SlowVfricCoef, OfALawWithoutPressureStaysFiniteAndItsForceGoesToZero) {
  static const Table table = one_axis_table(); // tau_R of psi alone
  static const TableFunction function(table);
  auto c = this->call(4);
  c.properties = {TypeParam(psi)};
  c.pressure = {TypeParam(0), TypeParam(1e-6), TypeParam(1e-3), TypeParam(100)};
  this->run(c, this->routine("one_axis", table));
  const double state[] = {psi};
  const double tau = function(state);
  for (const std::size_t k : {0, 1, 2})
    EXPECT_EQ(c.coefficient[k], 10) << "the most that a solver gets";
  EXPECT_CLOSE(c.coefficient[3] * c.pressure[3], tau, this->bound);
}

TYPED_TEST(SlowVfricCoef, NeverExceedsTheShearLimit) {
  auto c = this->call(3);
  c.pressure = {TypeParam(2750), TypeParam(1e5), TypeParam(1e20)};
  c.properties[2] = TypeParam(1);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_CLOSE(double(c.coefficient[k]) * double(c.pressure[k]), 0.8 * 0.5773502691896258,
                 this->bound);
}

TYPED_TEST(SlowVfricCoef, TakesTheSlipRateAsASize) {
  auto c = this->call(1);
  c.slip_rate[0] = TypeParam(-50);
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.coefficient[0], this->tau(1000, 50, 100) / 1000, this->bound);
}

TYPED_TEST(SlowVfricCoef, TakesHistoriesFromFieldsAndConstantsBecauseItHasNone) {
  static const Table table = branching_table();
  auto c = this->call(2, 1);
  c.properties = {TypeParam(flow)};
  for (std::size_t k = 0; k < 2; ++k)
    this->set(c, k, 300, 20, 0);
  c.field = {4, 12};
  this->run(c, this->routine("field", table, {{"s_mm", "field:1"}}));
  EXPECT_CLOSE(c.coefficient[0], branching_tau(300, 20, 4) / 300, this->bound);
  EXPECT_CLOSE(c.coefficient[1], branching_tau(300, 20, 12) / 300, this->bound);
  this->run(c, this->routine("constant", table, {{"s_mm", "constant:12"}}));
  EXPECT_CLOSE(c.coefficient[0], branching_tau(300, 20, 12) / 300, this->bound);
}

TYPED_TEST(SlowVfricCoef, RefusesNothingOutOfContact) {
  static const Table table = sides_table(); // v above and T below: error
  static const TableFunction function(table);
  void* routine = this->routine("sides", table);
  auto c = this->call(4);
  c.properties = {TypeParam(100), TypeParam(flow)};
  this->set(c, 0, 1000, 600, 100);
  this->set(c, 1, 0, 600, 100);
  this->set(c, 2, 0, 50, 100);
  this->set(c, 3, 0, 600, nan);
  this->run(c, routine);
  EXPECT_TRUE(std::isnan(c.coefficient[0])) << "where the solver's routine comes back";
  const double at_end[] = {1e-3, 500, 100, flow}, inside[] = {1e-3, 50, 100, flow};
  EXPECT_CLOSE(c.coefficient[1], function(at_end) / 1e-3, this->bound);
  EXPECT_CLOSE(c.coefficient[2], function(inside) / 1e-3, this->bound);
  EXPECT_TRUE(std::isnan(c.coefficient[3]));
}

TYPED_TEST(SlowVfricCoef, SaysThatItsArgumentListIsRecalled) {
  const codegen::SourceBundle files =
      codegen::find_exporter("abaqus_vfric_coef")->generate({four_axis(), "mm-t-s", {}});
  for (const char* name : {"frictab_vfric_coef.f", "recipe.json", "README.md"})
    EXPECT_THAT(files.at(name),
                testing::AllOf(testing::HasSubstr("recalled:"),
                               testing::ContainsRegex("check against[ \n]your release")))
        << name;
}

} // namespace

} // namespace frictab::explicit_routines_test
