// The entry of the contract, beyond agreement: batch form, range flags, NaN, threads, whatever
// language it is written in.
#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab::entry_test {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Entry = double(double, double, double, double, double, double);
using Outside = unsigned(double, double, double, double, double, double);
using Array = const double*;
using Batch = void(std::size_t, Array, Array, Array, Array, Array, Array, double*);

class SlowEntryOf : public testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    static const table::Table table = test::four_axis_table();
    const codegen::ExportRequest request{table, "mm-t-s", {}};
    const codegen::Exporter& exporter = *codegen::find_exporter(GetParam());
    const std::string variant = exporter.variants(request)[0].name;
    library_ = test::compiled("four_axes", exporter, request, variant);
    if (!library_) GTEST_SKIP() << "the compiler is missing";
  }
  const codegen::Library& library() const { return *library_; }

private:
  const codegen::Library* library_ = nullptr;
};

TEST_P(SlowEntryOf, TellsByBitsWhichAxesAreLeft) {
  const auto outside = library().find<Outside>("frictab_outside");
  EXPECT_EQ(outside(1000, 2, 50, 100, 0, 480), 0u);
  EXPECT_EQ(outside(500, 1, 5, 20, 0, 480), 0u);
  EXPECT_EQ(outside(2750, 20, 500, 200, 0, 480), 0u);
  EXPECT_EQ(outside(499, 2, 50, 100, 0, 480), 1u);
  EXPECT_EQ(outside(1000, 21, 50, 100, 0, 480), 2u);
  EXPECT_EQ(outside(1000, 2, 0, 100, 0, 480), 4u);
  EXPECT_EQ(outside(1000, 2, 50, -inf, 0, 480), 8u);
  EXPECT_EQ(outside(inf, inf, inf, inf, 0, 480), 15u);
}

TEST_P(SlowEntryOf, TellsByBitsWhichHeldInputsAreLeft) {
  static const table::Table table = test::held_inputs_table();
  const codegen::ExportRequest request{table, "mm-t-s", {}};
  const codegen::Exporter& exporter = *codegen::find_exporter(GetParam());
  const codegen::Library& held =
      *test::compiled("held", exporter, request, exporter.variants(request)[0].name);
  const auto outside = held.find<unsigned(double, double, double, double, double, double, double)>(
      "frictab_outside");
  EXPECT_EQ(outside(1000, 2, 50, 100, 0, 480, 45), 0u);
  EXPECT_EQ(outside(1000, 2, 50, 100, 0, 480, 29), 1u);
  EXPECT_EQ(outside(1000, 2, 50, 100, 0, 480, 61), 1u);
}

TEST_P(SlowEntryOf, GivesTheSameBitsInBatchAndTakesNullForWhatItDoesNotUse) {
  const table::Table table = test::four_axis_table();
  const test::States states(table, 1000, 5);
  const auto& c = states.columns();
  std::vector<double> tau(1000);
  library().find<Batch>("frictab_tau_R_batch")(1000, c[0], c[1], c[2], c[3], nullptr, c[4],
                                               tau.data());
  const auto entry = library().find<Entry>("frictab_tau_R");
  for (std::size_t i = 0; i < 1000; ++i)
    EXPECT_EQ(tau[i], entry(c[0][i], c[1][i], c[2][i], c[3][i], nan, c[4][i]));
}

TEST_P(SlowEntryOf, GivesNaNForNaNInWhatItUsesOnly) {
  const auto entry = library().find<Entry>("frictab_tau_R");
  for (std::size_t i = 0; i < 6; ++i) {
    double x[] = {1000, 2, 50, 100, 1, 480};
    x[i] = nan;
    EXPECT_EQ(std::isnan(entry(x[0], x[1], x[2], x[3], x[4], x[5])), i != 4) << i;
  }
}

TEST_P(SlowEntryOf, ComparesNoNaNWhereInvalidOperationsTrap) {
  static const table::Table table = test::sides_table(); // with ends that are errors
  const codegen::ExportRequest request{table, "mm-t-s", {}};
  const codegen::Exporter& exporter = *codegen::find_exporter(GetParam());
  const codegen::Library& sides =
      *test::compiled("sides", exporter, request, exporter.variants(request)[0].name);
  const auto entry = sides.find<Entry>("frictab_tau_R");
  const auto outside = sides.find<Outside>("frictab_outside");
  const auto gradient = sides.find<double(double, double, double, double, double, double, double*)>(
      "frictab_tau_R_gradient");
  for (const std::size_t i : {0, 2, 3, 5}) {
    double x[] = {1000, 2, 900, 100, 1, 480}, slopes[6]; // beyond an end that is an error
    x[i] = nan;
    const test::FloatTraps traps;
    EXPECT_TRUE(std::isnan(entry(x[0], x[1], x[2], x[3], x[4], x[5]))) << i;
    EXPECT_TRUE(std::isnan(gradient(x[0], x[1], x[2], x[3], x[4], x[5], slopes))) << i;
    EXPECT_EQ(outside(x[0], x[1], x[2], x[3], x[4], x[5]), i == 2 ? 0u : 2u) << i;
  }
}

TEST_P(SlowEntryOf, ClampsInfinitiesToTheEdgeOfTheTable) {
  const auto entry = library().find<Entry>("frictab_tau_R");
  EXPECT_EQ(entry(1000, inf, 50, 100, 0, 480), entry(1000, 20, 50, 100, 0, 480));
  EXPECT_EQ(entry(1000, 2, -inf, 100, 0, 480), entry(1000, 2, 5, 100, 0, 480));
  EXPECT_EQ(entry(inf, 2, 50, 100, 0, 480), 0.8 * (0.5773502691896258 * 480));
}

TEST_P(SlowEntryOf, MayRunInThreadsAtOnce) {
  const auto entry = library().find<Entry>("frictab_tau_R");
  const auto sweep = [entry] {
    std::vector<double> tau;
    for (int i = 0; i < 20000; ++i)
      tau.push_back(entry(500 + i % 2300, 1 + i % 19, 5 + i % 490, 20 + i % 180, 0, 480));
    return tau;
  };
  const std::vector<double> serial = sweep();
  std::vector<std::vector<double>> parallel(4);
  std::vector<std::thread> threads;
  for (auto& result : parallel)
    threads.emplace_back([&result, &sweep] { result = sweep(); });
  for (std::thread& thread : threads)
    thread.join();
  for (const auto& result : parallel)
    EXPECT_EQ(result, serial);
}

INSTANTIATE_TEST_SUITE_P(Targets, SlowEntryOf, testing::Values("c", "fortran"),
                         [](const testing::TestParamInfo<std::string>& given) {
                           return given.param;
                         });

} // namespace

} // namespace frictab::entry_test
