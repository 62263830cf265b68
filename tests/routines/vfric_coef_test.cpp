// VFRIC_COEF called through the argument list that is recalled for it, in both precisions, with
// bounds checked and floating point traps on.
#include <cmath>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/calls/vfric_coef.h"
#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::vfric_coef_test {

using table::Table;
using table::TableFunction;

namespace {

using calls::VfricCoefCall;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// psi, sigma_f: what the tests pass as properties; T is property 2 of the four-axis table.
constexpr double psi = 2.5, flow = 480;
constexpr double shear_limit = 0.8 * 0.5773502691896258 * flow;

template <class Real> class SlowVfricCoef : public testing::Test {
protected:
  static constexpr bool single = sizeof(Real) == 4;
  // Double: the order of operations only. Single: see agreement_test.cpp.
  static constexpr double bound = single ? 2e-5 : 1e-13;

  void SetUp() override {
    if (!have_program("gfortran")) GTEST_SKIP() << "gfortran is not installed";
  }

  static void* routine(const std::string& key, const Table& table,
                       const std::map<std::string, std::string>& inputs = {},
                       const std::string& units = "mm-t-s",
                       const std::vector<std::string>& flags = test::strict) {
    const codegen::ExportRequest request{table, units, inputs};
    return codegen::Library::address(test::compiled(key,
                                                    *codegen::find_exporter("abaqus_vfric_coef"),
                                                    request, single ? "single" : "double", flags)
                                         ->handle(),
                                     "vfric_coef_");
  }
  static void* four_axes() { return routine("four_axes", four_axis()); }
  static const Table& four_axis() {
    static const Table table = test::four_axis_table();
    return table;
  }

  // 1000 MPa, 50 mm/s, 100 degC at every point.
  static VfricCoefCall<Real> call(int points, int fields = 0) {
    VfricCoefCall<Real> c;
    c.temperatures = true;
    c.properties = {Real(psi), Real(60), Real(flow)};
    c.fields = fields;
    c.resize(points);
    for (std::size_t k = 0; k < static_cast<std::size_t>(points); ++k)
      set(c, k, 1000, 50, 100);
    return c;
  }

  static void set(VfricCoefCall<Real>& c, std::size_t k, double pressure, double speed,
                  double temperature) {
    c.pressure[k] = static_cast<Real>(pressure);
    c.slip_rate[k] = static_cast<Real>(speed);
    c.temperature[k] = static_cast<Real>(temperature);
  }

  static void run(VfricCoefCall<Real>& c, void* function) {
    std::fill(c.coefficient.begin(), c.coefficient.end(), Real(777));
    std::fill(c.derivative.begin(), c.derivative.end(), Real(777));
    const test::FloatTraps traps;
    c.run(function);
  }

  static double tau(double pressure, double speed, double temperature) {
    static const TableFunction table(four_axis());
    const double state[] = {pressure, psi, speed, temperature, flow};
    return table(state);
  }
};

using Precisions = testing::Types<double, float>;
struct PrecisionName {
  template <class Real> static std::string GetName(int) {
    return sizeof(Real) == 4 ? "single" : "double";
  }
};
TYPED_TEST_SUITE(SlowVfricCoef, Precisions, PrecisionName);

TYPED_TEST(SlowVfricCoef, GivesTauOverPressureInBlocksOf0And1And136And512) {
  for (const int points : {0, 1, 136, 512}) {
    auto c = this->call(points);
    for (std::size_t k = 0; k < c.pressure.size(); ++k)
      this->set(c, k, 600 + 2.0 * double(k), 10 + double(k % 100), 50);
    this->run(c, this->four_axes());
    for (std::size_t k = 0; k < c.pressure.size(); ++k) {
      const double p = 600 + 2.0 * double(k);
      EXPECT_CLOSE(c.coefficient[k], this->tau(p, 10 + double(k % 100), 50) / p,
                   TestFixture::bound);
    }
  }
}

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
    EXPECT_CLOSE(c.coefficient[k], this->tau(500, 50, 100) / 500, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, OfALawWithoutPressureStaysFiniteAndItsForceGoesToZero) {
  static const Table table = test::one_axis_table(); // tau_R of psi alone
  static const TableFunction function(table);
  auto c = this->call(4);
  c.properties = {TypeParam(psi)};
  c.pressure = {TypeParam(0), TypeParam(1e-6), TypeParam(1e-3), TypeParam(100)};
  this->run(c, this->routine("one_axis", table));
  const double state[] = {psi};
  const double tau = function(state);
  for (const std::size_t k : {0, 1, 2})
    EXPECT_EQ(c.coefficient[k], 10) << "the most that a solver gets";
  EXPECT_CLOSE(c.coefficient[3] * c.pressure[3], tau, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, NeverExceedsTheShearLimit) {
  auto c = this->call(3);
  c.pressure = {TypeParam(2750), TypeParam(1e5), TypeParam(1e20)};
  c.properties[2] = TypeParam(1);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_CLOSE(double(c.coefficient[k]) * double(c.pressure[k]), shear_limit / flow,
                 TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, TakesTheSlipRateAsASize) {
  auto c = this->call(1);
  c.slip_rate[0] = TypeParam(-50);
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.coefficient[0], this->tau(1000, 50, 100) / 1000, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, TakesTheReferenceTemperatureWhereTheModelHasNone) {
  auto c = this->call(1);
  c.temperatures = false;
  c.temperature[0] = TypeParam(nan);
  this->run(c, this->four_axes());
  EXPECT_CLOSE(c.coefficient[0], this->tau(1000, 50, 60) / 1000, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, GivesNaNForNaNInAnyArgumentItUses) {
  using Spoil = void (*)(VfricCoefCall<TypeParam>&);
  static constexpr TypeParam bad = std::numeric_limits<TypeParam>::quiet_NaN();
  const std::pair<std::string, Spoil> spoils[] = {
      {"pressure", [](auto& c) { c.pressure[1] = bad; }},
      {"slipRate", [](auto& c) { c.slip_rate[1] = bad; }},
      {"tempAvg", [](auto& c) { c.temperature[1] = bad; }},
      {"props", [](auto& c) { c.properties[2] = bad; }}};
  for (const auto& [name, spoil] : spoils) {
    auto c = this->call(3);
    spoil(c);
    this->run(c, this->four_axes());
    EXPECT_TRUE(std::isnan(c.coefficient[1])) << name;
    if (name != "props") {
      EXPECT_CLOSE(c.coefficient[2], this->tau(1000, 50, 100) / 1000, TestFixture::bound);
    }
  }
}

TYPED_TEST(SlowVfricCoef, TakesInfinitiesAsFarOutsideTheTable) {
  auto c = this->call(3);
  c.pressure[0] = TypeParam(inf);
  c.slip_rate[1] = TypeParam(inf);
  c.temperature[2] = TypeParam(-inf);
  this->run(c, this->four_axes());
  EXPECT_NEAR(c.coefficient[0], 0, 1e-20); // a finite shear limit over it
  EXPECT_CLOSE(c.coefficient[1], this->tau(1000, 1e9, 100) / 1000, TestFixture::bound);
  EXPECT_CLOSE(c.coefficient[2], this->tau(1000, 50, -1e9) / 1000, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, UsesTheNearestEdgeOutsideEachSideOfEachAxis) {
  const double states[][3] = {{100, 50, 100},    {4000, 50, 100}, {1000, 1, 100},
                              {1000, 2000, 100}, {1000, 50, -40}, {1000, 50, 900}};
  auto c = this->call(6);
  for (std::size_t k = 0; k < 6; ++k)
    this->set(c, k, states[k][0], states[k][1], states[k][2]);
  this->run(c, this->four_axes());
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_CLOSE(c.coefficient[k],
                 this->tau(states[k][0], states[k][1], states[k][2]) / states[k][0],
                 TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, TakesHistoriesFromFieldsAndConstantsBecauseItHasNone) {
  static const Table table = test::branching_table();
  static const TableFunction function(table);
  auto c = this->call(2, 1);
  c.properties = {TypeParam(flow)};
  for (std::size_t k = 0; k < 2; ++k)
    this->set(c, k, 300, 20, 0);
  c.field = {4, 12};
  this->run(c, this->routine("field", table, {{"s_mm", "field:1"}}));
  const double first[] = {300, 20, 4, flow}, second[] = {300, 20, 12, flow};
  EXPECT_CLOSE(c.coefficient[0], function(first) / 300, TestFixture::bound);
  EXPECT_CLOSE(c.coefficient[1], function(second) / 300, TestFixture::bound);
  this->run(c, this->routine("constant", table, {{"s_mm", "constant:12"}}));
  EXPECT_CLOSE(c.coefficient[0], function(second) / 300, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, TakesTypicalValuesForPropertiesTheDeckDoesNotGive) {
  static const TableFunction table(this->four_axis());
  auto c = this->call(1);
  c.properties.clear();
  this->run(c, this->four_axes());
  const double state[] = {1000, std::sqrt(20.0), 50, 100, 480};
  EXPECT_CLOSE(c.coefficient[0], table(state) / 1000, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, ConvertsUnitsOfMetreKilogramSecond) {
  void* function = this->routine("si", this->four_axis(), {}, "m-kg-s");
  auto c = this->call(2);
  c.properties = {TypeParam(psi), TypeParam(60), TypeParam(480e6)};
  this->set(c, 0, 1000e6, 0.05, 100);
  this->set(c, 1, 0, 0.05, 100);
  this->run(c, function);
  EXPECT_CLOSE(c.coefficient[0], this->tau(1000, 50, 100) / 1000, TestFixture::bound);
  EXPECT_CLOSE(c.coefficient[1], this->tau(500, 50, 100) / 500, TestFixture::bound);
}

TYPED_TEST(SlowVfricCoef, RefusesNothingOutOfContact) {
  static const Table table = test::sides_table(); // v above and T below: error
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
  EXPECT_CLOSE(c.coefficient[1], function(at_end) / 1e-3, TestFixture::bound);
  EXPECT_CLOSE(c.coefficient[2], function(inside) / 1e-3, TestFixture::bound);
  EXPECT_TRUE(std::isnan(c.coefficient[3]));
}

TYPED_TEST(SlowVfricCoef, SaysThatItsArgumentListIsRecalled) {
  const codegen::SourceBundle files =
      codegen::find_exporter("abaqus_vfric_coef")->generate({this->four_axis(), "mm-t-s", {}});
  for (const auto& [name, text] : files)
    EXPECT_THAT(text, testing::AllOf(testing::HasSubstr("recalled:"),
                                     testing::HasSubstr("check against your release")))
        << name;
}

TYPED_TEST(SlowVfricCoef, MayRunInThreadsAtOnce) {
  // Not with -fcheck=recursion: its own flag is shared by all threads.
  void* function = this->routine("threads", this->four_axis(), {}, "mm-t-s", {"-O2"});
  auto reference = this->call(136);
  for (std::size_t k = 0; k < 136; ++k)
    this->set(reference, k, 600 + 10 * double(k), 10 + double(k), 50);
  auto serial = reference;
  this->run(serial, function);
  std::vector<VfricCoefCall<TypeParam>> calls(4, reference);
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
  for (const auto& c : calls)
    EXPECT_EQ(c.coefficient, serial.coefficient);
}

} // namespace

} // namespace frictab::vfric_coef_test
