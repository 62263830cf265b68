// USRFRC called as LS-DYNA calls it, in both precisions, with bounds checked and floating point
// traps on.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include <dlfcn.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "routines/abaqus_routines.h"
#include "support/calls/usrfrc.h"
#include "support/generated.h"
#include "support/sample_tables.h"
#include "support/solver_scale.h"

namespace frictab::lsdyna_test {

using codegen::Library;
using table::Table;
using table::TableFunction;

namespace {

using testing::HasSubstr;
using namespace test;

const codegen::Exporter& lsdyna() {
  return *codegen::find_exporter("lsdyna_usrfrc");
}

template <class Real> struct LongLsDyna : test::NeedsGfortran {
  static constexpr bool single = sizeof(Real) == 4;
  using Int = std::conditional_t<single, std::int32_t, std::int64_t>;
  using Call = calls::UsrfrcCall<Real, Int>;
  // Double: the order of operations only. Single: see agreement_test.cpp.
  static constexpr double bound = single ? 2e-5 : 1e-13;
  static constexpr const char* variant = single ? "single" : "double";

  static const Library& library(const std::string& key, const Table& table,
                                const std::map<std::string, std::string>& inputs = {},
                                const codegen::SolverUnits& units = {}) {
    return *test::compiled(key, lsdyna(), {table, units, inputs}, variant, test::strict_declared);
  }
  static const Library& four_axes() { return library("four_axes", four_axis()); }
  static const Library& branching() { return library("branching", test::branching_table()); }

  // For the four-axis table: 1000 MPa, 50 mm/s across the force before, 100 degC everywhere.
  static Call call(std::size_t places) {
    Call c;
    c.rate = Real(0x1p20);
    c.constants = {Real(psi), Real(60), Real(flow)};
    c.resize(places);
    for (std::size_t i = 0; i < places; ++i)
      set(c, i, 1000, 50);
    std::fill(c.temperature.begin(), c.temperature.end(), Real(100));
    return c;
  }
  static void set(Call& c, std::size_t i, double pressure, double speed) {
    c.normal[i] = -static_cast<Real>(pressure) * c.area[i];
    c.slip[1][i] = static_cast<Real>(speed) / c.rate;
  }

  static void run(Call& c, const Library& library, bool thermal = true) {
    if (void* switches = dlsym(library.handle(), "thropt_"))
      *static_cast<Int*>(switches) = thermal ? 999 : 0;
    const test::FloatTraps traps;
    c.run(Library::address(library.handle(), "usrfrc_"));
  }
  static double tau(double pressure = 1000, double speed = 50, double temperature = 100) {
    return four_axis_tau(pressure, speed, temperature);
  }
};

using Precisions = testing::Types<double, float>;
struct PrecisionName {
  template <class Real> static std::string GetName(int) {
    return sizeof(Real) == 4 ? "single" : "double";
  }
};
TYPED_TEST_SUITE(LongLsDyna, Precisions, PrecisionName);

TYPED_TEST(LongLsDyna, AgreesWithFrictabForEveryKindOfArgumentAndUnit) {
  for (const test::NamedTable& sample : test::sample_tables())
    for (const test::SolverScale& scale : test::every_system()) {
      if (!test::has_every_kind_of_argument(sample)) continue;
      SCOPED_TRACE(sample.name + " " + scale.name);
      const codegen::ExportRequest asked{sample.table, scale.units, {}};
      EXPECT_LE(
          test::worst_driven(lsdyna(), asked, TestFixture::single ? "single" : "double",
                             test::strict_declared,
                             {{"psi", 2.5}, {"sigma_f_MPa", 480.0}, {"humidity %, room", 41.0}}),
          TestFixture::bound);
    }
}

TYPED_TEST(LongLsDyna, TakesBlocksOf0And1And300Nodes) {
  for (const std::size_t places : {0, 1, 300}) {
    auto c = this->call(places);
    for (std::size_t i = 0; i < places; ++i)
      this->set(c, i, 600 + 2 * double(i), 10 + double(i % 100));
    this->run(c, this->four_axes());
    for (std::size_t i = 0; i < places; ++i)
      EXPECT_CLOSE(c.force[0][i], this->tau(600 + 2 * double(i), 10 + double(i % 100)),
                   TestFixture::bound);
  }
}

TYPED_TEST(LongLsDyna, TouchesActiveNodesOnlyAndFollowsTheirHistories) {
  auto c = this->call(5);
  c.active = {5, 2};
  c.history_of = {1, 2, 3, 4, 1};
  c.area = {1, 4, 1, 1, TypeParam(0.5)};
  this->set(c, 1, 800, 20);
  this->set(c, 4, 900, 30);
  const auto before = c.before;
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.force[0][1], this->tau(800, 20) * 4, TestFixture::bound);
  EXPECT_CLOSE(c.force[0][4], this->tau(900, 30) * 0.5, TestFixture::bound);
  EXPECT_EQ(c.history[4 * 1], c.slip[1][1]);
  EXPECT_EQ(c.history[4 * 0], c.slip[1][4]);
  EXPECT_EQ(c.history[4 * 1 + 2], 800);
  for (const std::size_t i : {0, 2, 3}) {
    EXPECT_EQ(c.force[0][i], 0);
    EXPECT_EQ(c.last_segment[i], 0);
    EXPECT_TRUE(std::equal(&before[5 * i], &before[5 * i + 5], &c.before[5 * i]));
  }
  EXPECT_EQ(c.history[4 * 2], 0);
}

TYPED_TEST(LongLsDyna, AddsTheForceAndKeepsItWithThePlaceForTheNextCycle) {
  auto c = this->call(1);
  c.force[0][0] = 10;
  c.force[2][0] = -7;
  c.s[0] = TypeParam(0.25), c.t[0] = TypeParam(-0.5);
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.force[0][0], 10 + this->tau(), TestFixture::bound);
  EXPECT_EQ(c.force[2][0], -7);
  EXPECT_EQ(c.before[0], c.s[0]);
  EXPECT_EQ(c.before[1], c.t[0]);
  EXPECT_CLOSE(c.before[2], this->tau(), TestFixture::bound);
  EXPECT_EQ(c.last_segment[0], c.segment[0]);
}

TYPED_TEST(LongLsDyna, GivesNoForceAlongTheNormalAndCountsTangentialSlipOnly) {
  auto c = this->call(1);
  const double n[] = {0.6, 0, 0.8};
  for (int i = 0; i < 3; ++i) {
    c.direction[i][0] = static_cast<TypeParam>(n[i]);
    c.slip[i][0] += static_cast<TypeParam>(5 * n[i]) / c.rate; // the node comes nearer as well
    c.before[2 + static_cast<std::size_t>(i)] = static_cast<TypeParam>(1e6 * (i + 1));
  }
  this->run(c, this->four_axes());
  double along = 0, size = 0;
  for (int i = 0; i < 3; ++i) {
    along += c.force[i][0] * n[i];
    size += double(c.force[i][0]) * double(c.force[i][0]);
  }
  // 0.6 and 0.8 are no unit vector in single precision to more than its last bits.
  EXPECT_NEAR(along, 0, 1e-6 * this->tau());
  EXPECT_NEAR(std::sqrt(size), this->tau(), 2e-5 * this->tau());
  EXPECT_GT(c.force[1][0], 0);
  EXPECT_NEAR(c.force[0][0] / c.force[1][0], (1 - 0.6 * 3) / 2, 1e-5);
  EXPECT_NEAR(c.history[0], 50 / double(c.rate), 2e-5 * 50 / double(c.rate));
}

TYPED_TEST(LongLsDyna, NeverExceedsTheForceThatHoldsTheNode) {
  auto c = this->call(3);
  c.before[2] = -5, c.before[3] = 0; // held by 5, the other way
  c.before[7] = 0;                   // nothing to hold
  c.before[12] = 3;
  c.stiffness[2] = 4, c.slip[0][2] = TypeParam(0.5); // 3 + 4*0.5
  c.slip[1][0] = c.slip[1][1] = c.slip[1][2] = 0;
  this->run(c, this->four_axes());
  EXPECT_EQ(c.force[0][0], -5);
  EXPECT_EQ(c.force[0][1], 0);
  EXPECT_CLOSE(c.force[0][2], 5, TestFixture::bound);
}

TYPED_TEST(LongLsDyna, HoldsElasticallyUntilItSlidesAtTauR) {
  auto c = this->call(1);
  std::fill(c.before.begin(), c.before.end(), TypeParam(0));
  c.slip[1][0] = 0;
  c.slip[0][0] = static_cast<TypeParam>(50) / c.rate;
  c.stiffness[0] = static_cast<TypeParam>(0.4 * this->tau()) / c.slip[0][0];
  for (const double part : {0.4, 0.8, 1.0, 1.0}) {
    c.force[0][0] = 0;
    this->run(c, this->four_axes());
    EXPECT_NEAR(c.force[0][0], part * this->tau(), 2e-5 * this->tau());
  }
}

TYPED_TEST(LongLsDyna, GivesNoForceWithoutPressureAndKeepsTheHistory) {
  auto c = this->call(2);
  c.normal = {0, 500}; // nothing, pulled
  c.history[4] = 3;
  this->run(c, this->four_axes());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(c.force[0][i], 0);
    EXPECT_EQ(c.before[5 * i + 2], 0) << "no force is carried over";
  }
  EXPECT_EQ(c.history[0], 0);
  EXPECT_EQ(c.history[4], 3);
}

TYPED_TEST(LongLsDyna, TakesASpeedOf0WhereTheTimeIncrementIs0) {
  auto c = this->call(2);
  c.rate = TypeParam(inf);
  c.slip[1][0] = 0;
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.force[0][0], this->tau(1000, 0), TestFixture::bound);
  EXPECT_CLOSE(c.force[0][1], this->tau(1000, 1e9), TestFixture::bound);
}

TYPED_TEST(LongLsDyna, GivesNaNForNaNInAnyArgumentItUses) {
  static constexpr TypeParam bad = TypeParam(nan);
  using Spoil = void (*)(typename TestFixture::Call&);
  const std::pair<const char*, Spoil> spoils[] = {{"fni", [](auto& c) { c.normal[1] = bad; }},
                                                  {"areas", [](auto& c) { c.area[1] = bad; }},
                                                  {"dx", [](auto& c) { c.slip[0][1] = bad; }},
                                                  {"rn", [](auto& c) { c.direction[2][1] = bad; }},
                                                  {"stfk", [](auto& c) { c.stiffness[1] = bad; }},
                                                  {"fdat", [](auto& c) { c.before[5 + 3] = bad; }},
                                                  {"frc", [](auto& c) { c.scale[2] = bad; }},
                                                  {"temp", [](auto& c) { c.temperature[1] = bad; }},
                                                  {"ss", [](auto& c) { c.s[1] = bad; }},
                                                  {"fdt2", [](auto& c) { c.rate = bad; }},
                                                  {"ua", [](auto& c) { c.constants[2] = bad; }}};
  for (const auto& [name, spoil] : spoils) {
    auto c = this->call(3);
    spoil(c);
    this->run(c, this->four_axes());
    EXPECT_TRUE(std::isnan(c.force[0][1])) << name;
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(c.history[4 + static_cast<std::size_t>(i)], 0) << name;
    if (std::string(name) != "fdt2" && std::string(name) != "ua") {
      EXPECT_CLOSE(c.force[0][2], this->tau(), TestFixture::bound) << name;
    }
  }
}

TYPED_TEST(LongLsDyna, GivesNaNForANaNHistory) {
  auto c = this->call(2);
  c.constants = {TypeParam(flow)};
  c.history[4] = TypeParam(nan);
  this->run(c, this->branching());
  EXPECT_FALSE(std::isnan(c.force[0][0]));
  EXPECT_TRUE(std::isnan(c.force[0][1]));
}

TYPED_TEST(LongLsDyna, TakesInfinitiesAsFarOutsideTheTable) {
  auto c = this->call(2);
  c.normal[0] = TypeParam(-inf);
  for (std::size_t n = 1; n < c.temperature.size(); n += 2)
    c.temperature[n] = TypeParam(-inf);
  c.s[1] = c.t[1] = TypeParam(0.5); // every corner counts: 0 times infinity is not asked for
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.force[0][0], 0.8 * 0.5773502691896258 * flow, TestFixture::bound);
  EXPECT_CLOSE(c.force[0][1], this->tau(1000, 50, -1e9), TestFixture::bound);
}

TYPED_TEST(LongLsDyna, UsesTheNearestEdgeOutsideEachSideOfEachAxis) {
  const double states[][2] = {{100, 50}, {4000, 50}, {1000, 1}, {1000, 2000}};
  auto c = this->call(4);
  for (std::size_t i = 0; i < 4; ++i)
    this->set(c, i, states[i][0], states[i][1]);
  this->run(c, this->four_axes());
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_CLOSE(c.force[0][i], this->tau(states[i][0], states[i][1]), TestFixture::bound);
  for (const double temperature : {-40.0, 900.0}) {
    auto hot = this->call(1);
    std::fill(hot.temperature.begin(), hot.temperature.end(), TypeParam(temperature));
    this->run(hot, this->four_axes());
    EXPECT_CLOSE(hot.force[0][0], this->tau(1000, 50, temperature), TestFixture::bound);
  }
}

TYPED_TEST(LongLsDyna, TakesTheMeanTemperatureOfTheNodeAndItsPlaceOnTheSegment) {
  auto c = this->call(2);
  c.temperature = {30, 60, 40, 0, 80, 0, 120, 0, 160, 0}; // node, then its four corners
  c.node = {1, 2};
  for (std::size_t n = 0; n < 4; ++n)
    c.corner[n] = {3 + 2 * static_cast<typename TestFixture::Int>(n), 4};
  c.s[0] = TypeParam(-0.5), c.t[0] = TypeParam(0.5); // 3/16, 1/16, 3/16, 9/16
  this->run(c, this->four_axes());
  const double segment = (3 * 40 + 80 + 3 * 120 + 9 * 160) / 16.0;
  EXPECT_CLOSE(c.force[0][0], this->tau(1000, 50, 0.5 * (30 + segment)), TestFixture::bound);
  EXPECT_CLOSE(c.force[0][1], this->tau(1000, 50, 30), TestFixture::bound);
}

TYPED_TEST(LongLsDyna, TakesTheReferenceTemperatureWhereNoneAreComputed) {
  auto c = this->call(1);
  std::fill(c.temperature.begin(), c.temperature.end(), TypeParam(nan));
  this->run(c, this->four_axes(), false);
  EXPECT_CLOSE(c.force[0][0], this->tau(1000, 50, 60), TestFixture::bound);
}

TYPED_TEST(LongLsDyna, WritesNoHistoryBeyondNHV) {
  for (const int histories : {0, 1, 2, 3, 5, 7, 8, 10}) {
    auto c = this->call(2);
    c.histories = histories;
    c.history.assign(2 * static_cast<std::size_t>(histories), TypeParam(0));
    this->set(c, 1, 400, 50); // outside the range
    this->run(c, this->four_axes());
    EXPECT_CLOSE(c.force[0][0], this->tau(), TestFixture::bound);
    if (histories >= 8) {
      EXPECT_CLOSE(c.history[6], this->tau(), TestFixture::bound);
      EXPECT_CLOSE(c.history[7], this->tau() / 1000, TestFixture::bound);
    }
    for (int i = histories >= 8 ? 8 : 6; i < histories; ++i)
      EXPECT_EQ(c.history[static_cast<std::size_t>(histories + i)], 0);
  }
}

TYPED_TEST(LongLsDyna, AddsSlipBeforeEvaluatingAndOncePerCall) {
  auto c = this->call(1);
  c.constants = {TypeParam(flow)};
  c.rate = 8;
  this->set(c, 0, 300, 40); // 5 mm
  for (int cycle = 1; cycle <= 3; ++cycle) {
    c.force[0][0] = 0;
    c.before[2] = TypeParam(0x1p60), c.before[3] = 0;
    this->run(c, this->branching());
    EXPECT_EQ(c.history[0], TypeParam(5 * cycle));
    EXPECT_CLOSE(c.force[0][0], branching_tau(300, 40, 5.0 * cycle), TestFixture::bound);
  }
}

TYPED_TEST(LongLsDyna, AddsWorkKeepsThePeakAndCountsCyclesOutside) {
  auto c = this->call(1);
  c.area[0] = 4;
  c.before[2] = 80, c.before[3] = 0;
  c.stiffness[0] = TypeParam(1e9), c.slip[0][0] = 0;
  this->set(c, 0, 1000, 50);
  this->run(c, this->four_axes());
  const double hold = std::hypot(80, 1e9 * double(c.slip[1][0])), fric = this->tau() * 4;
  ASSERT_GT(hold, 10 * fric) << "it slides";
  const double slip = (hold - fric) / 1e9, work = 0.5 * (80 + fric) / 4 * slip;
  EXPECT_CLOSE(double(c.history[0]), slip, TestFixture::bound)
      << "what is not elastic of the motion";
  EXPECT_CLOSE(double(c.history[1]), work, TestFixture::bound);
  this->set(c, 0, 700, 50);
  this->run(c, this->four_axes());
  EXPECT_EQ(c.history[2], 1000);
  EXPECT_EQ(c.history[3], 0);
  this->set(c, 0, 400, 50);
  for (int cycle = 0; cycle < 2; ++cycle)
    this->run(c, this->four_axes());
  EXPECT_EQ(c.history[3], 2);
}

TYPED_TEST(LongLsDyna, SumsOfSmallIncrementsDoNotStandStillInSinglePrecision) {
  for (const int histories : {4, 8}) {
    auto c = this->call(1);
    c.constants = {};
    c.histories = histories;
    c.history.assign(static_cast<std::size_t>(histories), TypeParam(0));
    c.history[0] = 40, c.history[1] = 40000; // mm, MPa mm
    c.slip[1][0] = TypeParam(1e-6);
    const Library& constant = this->library("constant", test::constant_table());
    constexpr int cycles = 100000;
    double work = 0;
    for (int cycle = 0; cycle < cycles; ++cycle) {
      c.force[0][0] = 0;
      c.before[2] = 200, c.before[3] = c.before[4] = 0; // MPa on 1 mm2
      this->run(c, constant);
      work += 0.5 * (200 + double(c.force[0][0])) * double(c.slip[1][0]);
    }
    ASSERT_GT(c.force[0][0], 0);
    if (histories == 4 && TestFixture::single) {
      EXPECT_EQ(c.history[0], 40) << "what a sum without its remainder does";
      EXPECT_EQ(c.history[1], 40000);
      continue;
    }
    // A unit in the last place of what is kept at the end, and of 100,000 sums in double.
    const double ulp = TestFixture::single ? 0x1p-24 : cycles * 0x1p-53;
    EXPECT_NEAR(double(c.history[0]), 40 + cycles * double(c.slip[1][0]), 41 * ulp);
    EXPECT_NEAR(double(c.history[1]), 40000 + work, 40020 * ulp);
  }
}

TYPED_TEST(LongLsDyna, KeepsNoSlipAndNoWorkOfANodeThatIsHeld) {
  auto c = this->call(1);
  c.area[0] = 4;
  c.before[2] = 80, c.before[3] = 0;
  c.stiffness[0] = 1, c.slip[0][0] = 0;
  this->set(c, 0, 1000, 50);
  this->run(c, this->four_axes());
  EXPECT_NEAR(std::hypot(double(c.force[0][0]), double(c.force[1][0])), 80, 1e-4);
  EXPECT_EQ(c.history[0], 0);
  EXPECT_EQ(c.history[1], 0);
}

TYPED_TEST(LongLsDyna, TakesWorkAndPeakPressureInTheSolversUnits) {
  const Table table = test::history_table();
  const TableFunction function(table);
  for (const test::SolverScale& scale : test::every_system()) {
    auto c = this->call(2);
    c.normal = {TypeParam(-700 * scale.stress), TypeParam(-1200 * scale.stress)};
    c.slip[1] = {0, 0};
    for (std::size_t i = 0; i < 2; ++i) {
      c.history[4 * i + 1] = TypeParam(200 * scale.stress * scale.length);
      c.history[4 * i + 2] = TypeParam(900 * scale.stress);
    }
    this->run(c, this->library("histories " + scale.name, table, {}, scale.units));
    const double below[] = {700, 200, 900}, above[] = {1200, 200, 1200};
    EXPECT_CLOSE(c.force[0][0], function(below) * scale.stress, TestFixture::bound);
    EXPECT_CLOSE(c.force[0][1], function(above) * scale.stress, TestFixture::bound);
  }
}

TYPED_TEST(LongLsDyna, TakesConstantsAsTheJobSaysAndTypicalValuesForThoseTheDeckDoesNotGive) {
  auto c = this->call(1);
  c.constants.clear();
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.force[0][0], four_axis_tau(1000, 50, 100, std::sqrt(20.0)), TestFixture::bound);
  auto said = this->call(1);
  said.constants = {TypeParam(9)};
  this->run(said, this->library("said", four_axis(),
                                {{"sigma_f_MPa", "constant:300"}, {"T_contact_C", "constant:80"}}));
  EXPECT_CLOSE(said.force[0][0], four_axis_tau(1000, 50, 80, 9, 300), TestFixture::bound);
  auto unknown = this->call(1);
  unknown.constants.clear();
  this->run(unknown, this->branching());
  EXPECT_TRUE(std::isnan(unknown.force[0][0])) << "a flow stress nobody knows";
}

TYPED_TEST(LongLsDyna, MultipliesByTheSegmentsScaleFactor) {
  auto c = this->call(2);
  c.segment = {2, 1};
  c.scale = {TypeParam(0.5), 9, 0, 9};
  this->run(c, this->four_axes());
  EXPECT_EQ(c.force[0][0], 0);
  EXPECT_CLOSE(c.force[0][1], 0.5 * this->tau(), TestFixture::bound);
}

TYPED_TEST(LongLsDyna, ConvertsUnitsOfMetreKilogramSecond) {
  auto c = this->call(1);
  c.constants[2] = TypeParam(480e6);
  this->set(c, 0, 1000e6, 0.05);
  this->run(c, this->library("si", four_axis(), {}, "m-kg-s"));
  EXPECT_CLOSE(c.force[0][0], this->tau() * 1e6, TestFixture::bound);
}

TYPED_TEST(LongLsDyna, EndsTheAnalysisOutsideAndWhereTheContactGivesNoAreas) {
  const Table table = test::sides_table();
  const codegen::ExportRequest asked{table, "mm-t-s", {}};
  codegen::BuildVariant build = lsdyna().variants(asked)[TestFixture::single ? 1 : 0];
  std::erase(build.command, "@{dir}/ftquit.f"); // the bundle's own
  build.extra["cstop.f"] = "      subroutine cstop(text)\n"
                           "      character*(*) text\n"
                           "      integer*4 calls\n"
                           "      common /told/ calls\n"
                           "      calls = calls + 1\n"
                           "      end\n";
  const TemporaryDirectory work;
  const Library own(codegen::compile_library(lsdyna().generate(asked), build, work.path()));
  const auto* calls = own.find<std::int32_t>("told_");
  auto c = this->call(2);
  c.constants = {TypeParam(100), TypeParam(flow)};
  this->run(c, own);
  EXPECT_EQ(*calls, 0);
  this->set(c, 1, 1000, 600);
  testing::internal::CaptureStdout();
  this->run(c, own);
  EXPECT_THAT(testing::internal::GetCapturedStdout(),
              HasSubstr("E+02 is outside the range: v_rel_mm_s above 500"));
  EXPECT_EQ(*calls, 1);
  EXPECT_FALSE(std::isnan(c.force[0][0]));
  EXPECT_TRUE(std::isnan(c.force[0][1])) << "where CSTOP comes back";
  auto bare = this->call(2);
  bare.area = {0, -1};
  bare.normal = {-5, 0}; // the second carries nothing
  testing::internal::CaptureStdout();
  this->run(bare, own);
  EXPECT_THAT(testing::internal::GetCapturedStdout(), HasSubstr("no nodal areas"));
  EXPECT_EQ(*calls, 2);
  EXPECT_TRUE(std::isnan(bare.force[0][0]));
  EXPECT_EQ(bare.force[0][1], 0);
}

TYPED_TEST(LongLsDyna, MayRunInThreadsAtOnce) {
  const Library* library = test::compiled("threads", lsdyna(), {four_axis(), "mm-t-s", {}},
                                          TestFixture::variant, {"-O2"});
  *library->template find<typename TestFixture::Int>("thropt_") = 999;
  void* function = Library::address(library->handle(), "usrfrc_");
  auto reference = this->call(128);
  for (std::size_t i = 0; i < 128; ++i)
    this->set(reference, i, 600 + 10 * double(i), 10 + double(i));
  test::expect_the_same_in_threads(reference, function,
                                   [](const auto& c) { return std::tie(c.force[0], c.history); });
}

} // namespace
} // namespace frictab::lsdyna_test
