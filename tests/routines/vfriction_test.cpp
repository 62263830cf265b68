// VFRICTION called as Abaqus/Explicit calls it, in both precisions, with bounds checked and
// floating point traps on. What the routine has no use for is NaN.
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "support/calls/vfriction.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::vfriction_test {

using table::TableFunction;

namespace {

using calls::VfrictionCall;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// psi, sigma_f: what the tests pass as properties; T is property 2 of the four-axis table.
constexpr double psi = 2.5, flow = 480;

template <class Real> class SlowVfriction : public testing::Test {
protected:
  static constexpr bool single = sizeof(Real) == 4;
  // Double: the order of operations only. Single: see agreement_test.cpp.
  static constexpr double bound = single ? 2e-5 : 1e-13;

  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  }

  static void* routine(const std::string& key, const table::Table& table,
                       const std::map<std::string, std::string>& inputs = {},
                       const std::string& units = "mm-t-s",
                       const std::vector<std::string>& flags = test::strict) {
    const codegen::ExportRequest request{table, units, inputs};
    return codegen::Library::address(test::compiled(key,
                                                    *codegen::find_exporter("abaqus_vfriction"),
                                                    request, single ? "single" : "double", flags)
                                         ->handle(),
                                     "vfriction_");
  }
  static void* four_axes() { return routine("four_axes", four_axis()); }
  static void* branching() { return routine("branching", test::branching_table()); }
  static const table::Table& four_axis() {
    static const table::Table table = test::four_axis_table();
    return table;
  }

  // 1000 MPa, 50 mm/s, 100 degC at every point of the call that `change` has made of the plain one.
  static VfrictionCall<Real> call(
      int points, void (*change)(VfrictionCall<Real>&) = [](auto&) {}) {
    VfrictionCall<Real> c;
    c.temperatures = true;
    c.time_increment = Real(0x1p-20);
    c.properties = {Real(psi), Real(60), Real(flow)};
    change(c);
    c.resize(points);
    for (std::size_t k = 0; k < static_cast<std::size_t>(points); ++k)
      set(c, k, 1000, 50, 100);
    return c;
  }

  static void set(VfrictionCall<Real>& c, std::size_t k, double pressure, double speed,
                  double temperature) {
    c.normal[k] = static_cast<Real>(pressure) * c.area[k];
    c.slip[k * static_cast<std::size_t>(c.directions)] =
        static_cast<Real>(speed) * c.time_increment;
    c.temperature[k] = static_cast<Real>(temperature);
    if (!c.rigid) c.temperature_main[k] = static_cast<Real>(temperature);
  }

  static void run(VfrictionCall<Real>& c, void* function) {
    std::fill(c.tangential.begin(), c.tangential.end(), Real(777));
    const test::FloatTraps traps;
    c.run(function);
  }

  static double tau(double pressure, double speed, double temperature) {
    static const TableFunction table(four_axis());
    const double state[] = {pressure, psi, speed, temperature, flow};
    return table(state);
  }

  static double force(const VfrictionCall<Real>& c, std::size_t k = 0) {
    return c.tangential[k * static_cast<std::size_t>(c.directions - 1)];
  }
};

using Precisions = testing::Types<double, float>;
struct PrecisionName {
  template <class Real> static std::string GetName(int) {
    return sizeof(Real) == 4 ? "single" : "double";
  }
};
TYPED_TEST_SUITE(SlowVfriction, Precisions, PrecisionName);

TYPED_TEST(SlowVfriction, TakesTwoDimensionsWithoutTouchingAThirdComponent) {
  auto c = this->call(3, [](auto& plain) { plain.directions = 2; });
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_CLOSE(this->force(c, k), -this->tau(1000, 50, 100), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, TakesThreeDimensionsAndLeavesTheSecondTangentZero) {
  auto c = this->call(2);
  const TypeParam part = c.slip[0];
  c.slip[0] = part * TypeParam(0.6); // the same speed, along two axes
  c.slip[1] = part * TypeParam(0.8);
  this->run(c, this->four_axes());
  EXPECT_NEAR(this->force(c, 0), -this->tau(1000, 50, 100), 1e-5 * this->tau(1000, 50, 100));
  EXPECT_EQ(c.tangential[1], 0);
  EXPECT_EQ(c.tangential[3], 0);
}

TYPED_TEST(SlowVfriction, WritesNothingWithoutAFrictionDirection) {
  auto c = this->call(2, [](auto& plain) { plain.directions = 1; });
  this->run(c, this->four_axes());
  EXPECT_TRUE(c.tangential.empty());
  EXPECT_EQ(c.state[0], c.slip[0]);
}

TYPED_TEST(SlowVfriction, TakesBlocksOf0And1And136And512) {
  for (const int points : {0, 1, 136, 512}) {
    auto c = this->call(points);
    for (std::size_t k = 0; k < c.normal.size(); ++k)
      this->set(c, k, 600 + 2.0 * double(k), 10 + double(k % 100), 50);
    this->run(c, this->four_axes());
    for (std::size_t k = 0; k < c.normal.size(); ++k)
      EXPECT_CLOSE(this->force(c, k), -this->tau(600 + 2.0 * double(k), 10 + double(k % 100), 50),
                   TestFixture::bound);
  }
}

TYPED_TEST(SlowVfriction, TakesAreaAndStateByContactPoint) {
  auto c = this->call(3);
  c.area = {8, 2, 4};
  for (std::size_t k = 0; k < 3; ++k)
    this->set(c, k, 800 + 100 * double(k), 20, 90);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 3; ++k) {
    const double pressure = 800 + 100 * double(k);
    EXPECT_CLOSE(this->force(c, k), -this->tau(pressure, 20, 90) * double(c.area[k]),
                 TestFixture::bound);
    EXPECT_EQ(c.state[6 * k], c.slip[3 * k]);
    EXPECT_EQ(c.state[6 * k + 2], TypeParam(pressure));
  }
}

TYPED_TEST(SlowVfriction, TakesAnAnalyticalRigidMainSurface) {
  auto c = this->call(4, [](auto& plain) { plain.rigid = true; });
  c.temperature_main[0] = 140;
  for (std::size_t k = 0; k < 4; ++k)
    this->set(c, k, 1000, 50, 60);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_CLOSE(this->force(c, k), -this->tau(1000, 50, 100), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, AdvancesAllColumnsOfAnEdgeAlikeAndUsesTheirMean) {
  static const TableFunction table(test::branching_table());
  auto c = this->call(2, [](auto& plain) { plain.edges = true; });
  c.properties = {TypeParam(flow)};
  for (std::size_t k = 0; k < 2; ++k)
    this->set(c, k, 300, 20, 0);
  for (std::size_t j = 0; j < 4; ++j)
    c.state[6 * (4 + j)] = TypeParam(2 * j); // second point: 0, 2, 4, 6 mm
  this->run(c, this->branching());
  const double slip = double(c.slip[0]);
  const double first[] = {300, 20, slip, flow}, second[] = {300, 20, 3 + slip, flow};
  EXPECT_CLOSE(this->force(c, 0), -table(first), TestFixture::bound);
  EXPECT_CLOSE(this->force(c, 1), -table(second), TestFixture::bound);
  for (std::size_t j = 0; j < 4; ++j) {
    EXPECT_EQ(c.state[6 * j], TypeParam(slip));
    EXPECT_NEAR(c.state[6 * (4 + j)] + c.state[6 * (4 + j) + 4], 2 * double(j) + slip, 1e-12);
    EXPECT_EQ(c.state[6 * j + 2], 300);
    EXPECT_GT(c.state[6 * j + 1], 0);
  }
}

TYPED_TEST(SlowVfriction, TakesTheReferenceTemperatureWhereTheModelHasNone) {
  auto c = this->call(2, [](auto& plain) { plain.temperatures = false; });
  std::fill(c.temperature.begin(), c.temperature.end(), TypeParam(nan));
  std::fill(c.temperature_main.begin(), c.temperature_main.end(), TypeParam(nan));
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->force(c), -this->tau(1000, 50, 60), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, TakesTheFirstIncrementWithoutDividingByItsZeroTime) {
  auto c = this->call(2);
  c.time_increment = 0;
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->force(c), -this->tau(1000, 0, 100), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, GivesNoForceWithoutAreaOrNormalForceAndKeepsTheState) {
  auto c = this->call(4);
  c.area = {0, -1, 1, 1};
  c.normal = {100, 100, 0, -50};
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(this->force(c, k), 0);
  EXPECT_EQ(c.state, std::vector<TypeParam>(c.state.size()));
}

TYPED_TEST(SlowVfriction, GivesNaNForNaNInAnyArgumentItUsesAndKeepsThatState) {
  using Spoil = void (*)(VfrictionCall<TypeParam>&);
  static constexpr TypeParam bad = std::numeric_limits<TypeParam>::quiet_NaN();
  const std::pair<std::string, Spoil> spoils[] = {
      {"fNormal", [](auto& c) { c.normal[1] = bad; }},
      {"areaCont", [](auto& c) { c.area[1] = bad; }},
      {"fStickForce", [](auto& c) { c.stick[1] = bad; }},
      {"dSlipFric", [](auto& c) { c.slip[4] = bad; }},
      {"tempSlv", [](auto& c) { c.temperature[1] = bad; }},
      {"tempMst", [](auto& c) { c.temperature_main[1] = bad; }},
      {"rData(3)", [](auto& c) { c.time_increment = bad; }},
      {"props", [](auto& c) { c.properties[2] = bad; }}};
  for (const auto& [name, spoil] : spoils) {
    auto c = this->call(3);
    spoil(c);
    this->run(c, this->four_axes());
    EXPECT_TRUE(std::isnan(this->force(c, 1))) << name;
    EXPECT_EQ(c.tangential[3], 0) << name;
    for (std::size_t i = 0; i < 6; ++i)
      EXPECT_EQ(c.state[6 + i], 0) << name;
    if (name != "rData(3)" && name != "props") {
      EXPECT_CLOSE(this->force(c, 2), -this->tau(1000, 50, 100), TestFixture::bound);
    }
  }
}

TYPED_TEST(SlowVfriction, TakesInfinitiesAsFarOutsideTheTable) {
  auto c = this->call(3);
  c.normal[0] = TypeParam(inf); // beyond the shear limit
  c.slip[3] = TypeParam(inf);
  c.temperature[2] = TypeParam(-inf);
  this->run(c, this->four_axes());
  EXPECT_CLOSE(this->force(c, 0), -0.8 * 0.5773502691896258 * flow, TestFixture::bound);
  EXPECT_CLOSE(this->force(c, 1), -this->tau(1000, 1e9, 100), TestFixture::bound);
  EXPECT_CLOSE(this->force(c, 2), -this->tau(1000, 50, -1e9), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, UsesTheNearestEdgeOutsideEachSideOfEachAxisAndCountsIt) {
  const double states[][3] = {{100, 50, 100},  {4000, 50, 100}, {1000, 1, 100}, {1000, 2000, 100},
                              {1000, 50, -40}, {1000, 50, 900}, {1000, 50, 100}};
  auto c = this->call(7);
  for (std::size_t k = 0; k < 7; ++k)
    this->set(c, k, states[k][0], states[k][1], states[k][2]);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 7; ++k) {
    EXPECT_CLOSE(this->force(c, k), -this->tau(states[k][0], states[k][1], states[k][2]),
                 TestFixture::bound);
    EXPECT_EQ(c.state[6 * k + 3], k < 6 ? 1 : 0);
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
      EXPECT_CLOSE(this->force(c, 1), -this->tau(1000, 50, 100), TestFixture::bound);
      for (int i = 8; i < states; ++i)
        EXPECT_EQ(c.state[static_cast<std::size_t>(i)], 0);
      if (states >= 8) {
        EXPECT_CLOSE(c.state[6], this->tau(1000, 50, 100), TestFixture::bound);
        EXPECT_CLOSE(c.state[7], this->tau(1000, 50, 100) / 1000, TestFixture::bound);
      }
      if (states > 0) {
        EXPECT_EQ(c.state[0], c.slip[0]);
      }
    }
}

TYPED_TEST(SlowVfriction, TakesTypicalValuesForPropertiesTheDeckDoesNotGive) {
  auto c = this->call(1);
  c.properties.clear();
  this->run(c, this->four_axes());
  static const TableFunction table(this->four_axis());
  const double state[] = {1000, std::sqrt(20.0), 50, 100, 480};
  EXPECT_CLOSE(this->force(c), -table(state), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, TakesStatesFromFieldsAndConstantsAsTheJobSays) {
  static const TableFunction table(this->four_axis());
  void* function = this->routine(
      "fields", this->four_axis(),
      {{"psi", "field:2"}, {"sigma_f_MPa", "constant:300"}, {"T_contact_C", "field:1"}});
  auto c = this->call(1);
  c.properties.clear();
  c.fields = 2;
  c.resize(2);
  for (std::size_t k = 0; k < 2; ++k)
    this->set(c, k, 1000, 50, 0);
  c.field = {80, 3, 90, 5}; // both fields of the first point, then of the second
  c.field_main = {40, 5, 110, 9};
  this->run(c, function);
  const double first[] = {1000, 4, 50, 60, 300}, second[] = {1000, 7, 50, 100, 300};
  EXPECT_CLOSE(this->force(c, 0), -table(first), TestFixture::bound);
  EXPECT_CLOSE(this->force(c, 1), -table(second), TestFixture::bound);
  c.fields = 1; // field 2 is not there: the middle of the axis
  c.field = {80, 90}, c.field_main = {40, 110};
  this->run(c, function);
  const double fallback[] = {1000, std::sqrt(20.0), 50, 60, 300};
  EXPECT_CLOSE(this->force(c, 0), -table(fallback), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, TakesFieldsOfAnAnalyticalRigidMainSurface) {
  static const TableFunction table(this->four_axis());
  void* function = this->routine("field_rigid", this->four_axis(), {{"T_contact_C", "field:1"}});
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
    EXPECT_CLOSE(this->force(c, k), -this->tau(1000, 50, 60 + 5 * double(k)), TestFixture::bound);
}

TYPED_TEST(SlowVfriction, ConvertsUnitsOfMetreKilogramSecond) {
  void* function = this->routine("si", this->four_axis(), {}, "m-kg-s");
  auto c = this->call(1);
  c.properties = {TypeParam(psi), TypeParam(60), TypeParam(480e6)};
  this->set(c, 0, 1000e6, 0.05, 100);
  this->run(c, function);
  EXPECT_CLOSE(this->force(c), -this->tau(1000, 50, 100) * 1e6, TestFixture::bound);
}

TYPED_TEST(SlowVfriction, MayRunInThreadsAtOnce) {
  // Not with -fcheck=recursion: its own flag is shared by all threads.
  void* function = this->routine("threads", this->four_axis(), {}, "mm-t-s", {"-O2"});
  auto reference = this->call(136);
  for (std::size_t k = 0; k < 136; ++k)
    this->set(reference, k, 600 + 10 * double(k), 10 + double(k), 50);
  auto serial = reference;
  this->run(serial, function);
  std::vector<VfrictionCall<TypeParam>> calls(4, reference);
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

} // namespace frictab::vfriction_test
