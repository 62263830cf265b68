// VFRIC called as Abaqus/Explicit calls it, in both precisions, with bounds checked and floating
// point traps on: every trap of the interface that is known, by name.
#include <cmath>
#include <limits>
#include <numeric>
#include <thread>

#include <gtest/gtest.h>

#include "support/calls/vfric.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::vfric_test {

using table::TableFunction;

namespace {

using calls::VfricCall;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// psi, sigma_f: what the tests pass as properties; T is property 2 of the four-axis table.
constexpr double psi = 2.5, flow = 480;

template <class Real> class Vfric : public testing::Test {
protected:
  static constexpr bool single = sizeof(Real) == 4;
  // Double: the order of operations only. Single: see agreement_test.cpp.
  static constexpr double bound = single ? 2e-5 : 1e-13;

  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  }

  static void* routine(const std::string& key, const table::Table& table,
                       const std::map<std::string, std::string>& inputs = {},
                       const std::string& units = "mm-t-s") {
    const codegen::ExportRequest request{table, units, inputs};
    return codegen::Library::address(test::compiled(key, *codegen::find_exporter("abaqus_vfric"),
                                                    request, single ? "single" : "double",
                                                    test::strict)
                                         ->handle(),
                                     "vfric_");
  }
  static void* four_axes() { return routine("four_axes", four_axis()); }
  static void* branching() { return routine("branching", test::branching_table()); }
  static const table::Table& four_axis() {
    static const table::Table table = test::four_axis_table();
    return table;
  }

  // A call for the four-axis table: 1000 MPa, 50 mm/s, 100 degC at every point.
  static VfricCall<Real> call(int contacts, int directions = 3) {
    VfricCall<Real> c;
    c.directions = directions;
    c.temperatures = true;
    c.time_increment = Real(0x1p-20);
    c.properties = {Real(psi), Real(60), Real(flow)};
    c.resize(contacts, contacts);
    for (std::size_t k = 0; k < static_cast<std::size_t>(contacts); ++k)
      set(c, k, 1000, 50, 100);
    return c;
  }

  static void set(VfricCall<Real>& c, std::size_t k, double pressure, double speed,
                  double temperature) {
    const std::size_t node = static_cast<std::size_t>(c.node[k]) - 1;
    c.normal[k] = static_cast<Real>(pressure) * c.area[node];
    c.slip[k * static_cast<std::size_t>(c.directions)] =
        static_cast<Real>(speed) * c.time_increment;
    c.temperature[k] = static_cast<Real>(temperature);
    if (!c.rigid) c.temperature_main[k] = static_cast<Real>(temperature);
  }

  static void run(VfricCall<Real>& c, void* function) {
    std::fill(c.tangential.begin(), c.tangential.end(), Real(777));
    const test::FloatTraps traps;
    c.run(function);
  }

  static double tau(double pressure, double speed, double temperature) {
    static const TableFunction table(four_axis());
    const double state[] = {pressure, psi, speed, temperature, flow};
    return table(state);
  }

  static double force(const VfricCall<Real>& c, std::size_t k = 0) {
    return c.tangential[k * static_cast<std::size_t>(c.directions - 1)];
  }
};

using Precisions = testing::Types<double, float>;
struct PrecisionName {
  template <class Real> static std::string GetName(int) {
    return sizeof(Real) == 4 ? "single" : "double";
  }
};
TYPED_TEST_SUITE(Vfric, Precisions, PrecisionName);

TYPED_TEST(Vfric, Takes2DBlocksWithoutTouchingAThirdComponent) {
  auto c = this->call(3, 2);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_CLOSE(this->force(c, k), -this->tau(1000, 50, 100), TestFixture::bound);
}

TYPED_TEST(Vfric, Takes3DBlocksAndLeavesTheSecondTangentZero) {
  auto c = this->call(2, 3);
  const TypeParam part = c.slip[0];
  c.slip[0] = part * TypeParam(0.6); // the same speed, along all three axes
  c.slip[1] = part * TypeParam(0.8);
  this->run(c, this->four_axes());
  EXPECT_NEAR(this->force(c, 0), -this->tau(1000, 50, 100), 1e-5 * this->tau(1000, 50, 100));
  EXPECT_EQ(c.tangential[1], 0);
  EXPECT_EQ(c.tangential[3], 0);
}

TYPED_TEST(Vfric, TakesBlocksOf0And1And136And512) {
  for (const int contacts : {0, 1, 136, 512}) {
    auto c = this->call(contacts);
    for (std::size_t k = 0; k < c.node.size(); ++k)
      this->set(c, k, 600 + 2.0 * double(k), 10 + double(k % 100), 50);
    this->run(c, this->four_axes());
    for (std::size_t k = 0; k < c.node.size(); ++k)
      EXPECT_CLOSE(this->force(c, k), -this->tau(600 + 2.0 * double(k), 10 + double(k % 100), 50),
                   TestFixture::bound);
  }
}

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
    EXPECT_CLOSE(this->force(c, k), -this->tau(pressure, 20, 90) * area[k], TestFixture::bound);
    const std::size_t node = static_cast<std::size_t>(c.node[k]) - 1;
    EXPECT_EQ(c.state[3 * node], c.slip[3 * k]);
    EXPECT_EQ(c.state[3 * node + 2], TypeParam(pressure));
  }
  EXPECT_EQ(c.state[3 * 1], 0); // nodes that are not in contact
  EXPECT_EQ(c.state[3 * 3], 0);
}

TYPED_TEST(Vfric, TakesAnAnalyticalRigidMainSurface) {
  VfricCall<TypeParam> c = this->call(1);
  c.rigid = true;
  c.resize(4, 4);
  c.temperature_main[0] = 140;
  for (std::size_t k = 0; k < 4; ++k)
    this->set(c, k, 1000, 50, 60);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_CLOSE(this->force(c, k), -this->tau(1000, 50, 100), TestFixture::bound);
}

TYPED_TEST(Vfric, TakesTheReferenceTemperatureWhereTheModelHasNone) {
  auto c = this->call(2);
  c.temperatures = false;
  std::fill(c.temperature.begin(), c.temperature.end(), TypeParam(nan));
  std::fill(c.temperature_main.begin(), c.temperature_main.end(), TypeParam(nan));
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->force(c), -this->tau(1000, 50, 60), TestFixture::bound);
}

TYPED_TEST(Vfric, TakesTheFirstIncrementWithoutDividingByItsZeroTime) {
  auto c = this->call(2);
  c.time_increment = 0;
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->force(c), -this->tau(1000, 0, 100), TestFixture::bound);
}

TYPED_TEST(Vfric, GivesNoForceWithoutAreaOrNormalForceAndKeepsTheState) {
  auto c = this->call(4);
  c.area = {0, -1, 1, 1};
  c.normal = {100, 100, 0, -50};
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(this->force(c, k), 0);
    EXPECT_EQ(c.state[3 * k], 0);
  }
}

TYPED_TEST(Vfric, GivesNaNForNaNInAnyArgumentItUses) {
  using Spoil = void (*)(VfricCall<TypeParam>&);
  const TypeParam bad = TypeParam(nan);
  static TypeParam value;
  value = bad;
  const std::pair<const char*, Spoil> spoils[] = {
      {"fNormal", [](auto& c) { c.normal[1] = value; }},
      {"areaSec", [](auto& c) { c.area[1] = value; }},
      {"fStickForce", [](auto& c) { c.stick[1] = value; }},
      {"dSlipFric", [](auto& c) { c.slip[4] = value; }},
      {"tempSec", [](auto& c) { c.temperature[1] = value; }},
      {"tempMain", [](auto& c) { c.temperature_main[1] = value; }},
      {"dTimCur", [](auto& c) { c.time_increment = value; }},
      {"props", [](auto& c) { c.properties[2] = value; }}};
  for (const auto& [name, spoil] : spoils) {
    auto c = this->call(3);
    spoil(c);
    this->run(c, this->four_axes());
    EXPECT_TRUE(std::isnan(this->force(c, 1))) << name;
    EXPECT_EQ(c.tangential[3], 0) << name;
    for (std::size_t i = 3; i < 6; ++i)
      EXPECT_EQ(c.state[i], 0) << name;
    if (std::string(name) != "dTimCur" && std::string(name) != "props") {
      EXPECT_CLOSE(this->force(c, 2), -this->tau(1000, 50, 100), TestFixture::bound);
    }
  }
}

TYPED_TEST(Vfric, GivesNaNForANaNSlipHistory) {
  auto c = this->call(2);
  c.properties = {TypeParam(flow)};
  c.state[3] = TypeParam(nan);
  this->run(c, this->branching());
  EXPECT_FALSE(std::isnan(this->force(c, 0)));
  EXPECT_TRUE(std::isnan(this->force(c, 1)));
}

TYPED_TEST(Vfric, TakesInfinitiesAsFarOutsideTheTable) {
  auto c = this->call(3);
  c.normal[0] = TypeParam(inf); // beyond the shear limit
  c.slip[3] = TypeParam(inf);
  c.temperature[2] = TypeParam(-inf);
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->force(c, 0), -0.8 * 0.5773502691896258 * flow, TestFixture::bound);
  EXPECT_CLOSE(this->force(c, 1), -this->tau(1000, 1e9, 100), TestFixture::bound);
  EXPECT_CLOSE(this->force(c, 2), -this->tau(1000, 50, -1e9), TestFixture::bound);
}

TYPED_TEST(Vfric, UsesTheNearestEdgeOutsideEachSideOfEachAxis) {
  const double states[][3] = {{100, 50, 100},    {4000, 50, 100}, {1000, 1, 100},
                              {1000, 2000, 100}, {1000, 50, -40}, {1000, 50, 900}};
  auto c = this->call(6);
  for (std::size_t k = 0; k < 6; ++k)
    this->set(c, k, states[k][0], states[k][1], states[k][2]);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_CLOSE(this->force(c, k), -this->tau(states[k][0], states[k][1], states[k][2]),
                 TestFixture::bound);
}

TYPED_TEST(Vfric, WritesNoStateBeyondDEPVAR) {
  for (const int states : {0, 1, 2, 3, 5}) {
    auto c = this->call(1);
    c.states = states;
    c.resize(2, 2);
    for (std::size_t k = 0; k < 2; ++k)
      this->set(c, k, 1000, 50, 100);
    this->run(c, this->four_axes());
    EXPECT_CLOSE(this->force(c, 1), -this->tau(1000, 50, 100), TestFixture::bound);
    for (std::size_t i = 3; i < static_cast<std::size_t>(states); ++i)
      EXPECT_EQ(c.state[i], 0);
  }
}

TYPED_TEST(Vfric, CountsIncrementsInWhichAHeldInputIsOutsideWhatWasTested) {
  static const table::Table table = test::held_inputs_table();
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
  static const TableFunction table(test::branching_table());
  auto c = this->call(1);
  c.properties = {TypeParam(flow)};
  c.states = 0;
  c.resize(1, 1);
  this->set(c, 0, 300, 20, 0);
  this->run(c, this->branching());
  const double state[] = {300, 20, double(c.slip[0]), flow};
  EXPECT_CLOSE(this->force(c), -table(state), TestFixture::bound);
}

TYPED_TEST(Vfric, AddsSlipBeforeEvaluatingAndOncePerCall) {
  static const TableFunction table(test::branching_table());
  auto c = this->call(1);
  c.properties = {TypeParam(flow)};
  c.time_increment = TypeParam(0.125);
  this->set(c, 0, 300, 40, 0); // 5 mm
  for (int increment = 1; increment <= 3; ++increment) {
    this->run(c, this->branching());
    EXPECT_EQ(c.state[0], TypeParam(5 * increment));
    const double state[] = {300, 40, 5.0 * increment, flow};
    EXPECT_CLOSE(this->force(c), -table(state), TestFixture::bound);
  }
}

TYPED_TEST(Vfric, AddsFrictionWorkPerAreaAndKeepsThePeakPressure) {
  auto c = this->call(1);
  c.area[0] = 4;
  c.previous = {TypeParam(-80), 0, 0};
  this->set(c, 0, 1000, 50, 100);
  this->run(c, this->four_axes());
  const double work = 0.5 * (80 + this->tau(1000, 50, 100) * 4) / 4 * double(c.slip[0]);
  EXPECT_CLOSE(double(c.state[1]), work, TestFixture::bound);
  this->set(c, 0, 700, 50, 100);
  this->run(c, this->four_axes());
  EXPECT_EQ(c.state[2], 1000);
}

TYPED_TEST(Vfric, TakesTypicalValuesForPropertiesTheDeckDoesNotGive) {
  auto c = this->call(1);
  c.properties.clear();
  this->run(c, this->four_axes());
  static const TableFunction table(this->four_axis());
  const double state[] = {1000, std::sqrt(20.0), 50, 100, 480};
  EXPECT_CLOSE(this->force(c), -table(state), TestFixture::bound);
}

TYPED_TEST(Vfric, GivesNaNWhereAMissingPropertyHasNoTypicalValue) {
  auto c = this->call(1);
  c.properties.clear();
  this->run(c, this->branching());
  EXPECT_TRUE(std::isnan(this->force(c)));
}

TYPED_TEST(Vfric, TakesStatesFromFieldsAndConstantsAsTheJobSays) {
  static const TableFunction table(this->four_axis());
  void* function = this->routine(
      "fields", this->four_axis(),
      {{"psi", "field:2"}, {"sigma_f_MPa", "constant:300"}, {"T_contact_C", "field:1"}});
  auto c = this->call(1);
  c.properties.clear();
  c.predefined = 2;
  c.resize(2, 2);
  for (std::size_t k = 0; k < 2; ++k)
    this->set(c, k, 1000, 50, 0);
  c.field = {80, 90, 3, 5};
  c.field_main = {40, 110, 5, 9};
  this->run(c, function);
  const double first[] = {1000, 4, 50, 60, 300}, second[] = {1000, 7, 50, 100, 300};
  EXPECT_CLOSE(this->force(c, 0), -table(first), TestFixture::bound);
  EXPECT_CLOSE(this->force(c, 1), -table(second), TestFixture::bound);
  c.predefined = 1; // field 2 is not there: the middle of the axis
  this->run(c, function);
  const double fallback[] = {1000, std::sqrt(20.0), 50, 60, 300};
  EXPECT_CLOSE(this->force(c, 0), -table(fallback), TestFixture::bound);
}

TYPED_TEST(Vfric, ConvertsUnitsOfMetreKilogramSecond) {
  void* function = this->routine("si", this->four_axis(), {}, "m-kg-s");
  auto c = this->call(1);
  c.properties = {TypeParam(psi), TypeParam(60), TypeParam(480e6)};
  this->set(c, 0, 1000e6, 0.05, 100);
  this->run(c, function);
  EXPECT_CLOSE(this->force(c), -this->tau(1000, 50, 100) * 1e6, TestFixture::bound);
}

TYPED_TEST(Vfric, MayRunInThreadsAtOnce) {
  // Not with -fcheck=recursion: its own flag is shared by all threads.
  const codegen::ExportRequest request{this->four_axis(), "mm-t-s", {}};
  void* function = codegen::Library::address(
      test::compiled("threads", *codegen::find_exporter("abaqus_vfric"), request,
                     TestFixture::single ? "single" : "double", {"-O2"})
          ->handle(),
      "vfric_");
  auto reference = this->call(136);
  for (std::size_t k = 0; k < 136; ++k)
    this->set(reference, k, 600 + 10 * double(k), 10 + double(k), 50);
  auto serial = reference;
  this->run(serial, function);
  std::vector<VfricCall<TypeParam>> calls(4, reference);
  std::vector<std::thread> threads;
  for (auto& c : calls)
    threads.emplace_back([&c, &reference, function] {
      for (int i = 0; i < 200; ++i) {
        c = reference;
        c.run(function);
      }
    });
  for (std::thread& thread : threads)
    thread.join();
  for (const auto& c : calls) {
    EXPECT_EQ(c.tangential, serial.tangential);
    EXPECT_EQ(c.state, serial.state);
  }
}

} // namespace

} // namespace frictab::vfric_test
