// The C target beyond agreement: both compilers with every warning, batch form, range flags, NaN,
// threads.
#include <cmath>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/generated.h"
#include "support/sample_tables.h"

namespace frictab {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Entry = double(double, double, double, double, double, double);
using Outside = unsigned(double, double, double, double, double, double);
using Array = const double*;
using Batch = void(std::size_t, Array, Array, Array, Array, Array, Array, double*);

const Library& four_axes() {
  static const Table table = test::four_axis_table();
  const ExportRequest request{table, "mm-t-s", {}};
  return *test::compiled("four_axes", *find_exporter("c"), request, "c99");
}

TEST(CTarget, CompilesWithoutAWarningByGccAndClangAndAgrees) {
  const Exporter& c = *find_exporter("c");
  for (const std::string compiler : {"gcc", "clang"}) {
    if (!have_program(compiler)) GTEST_SKIP() << compiler << " is not installed";
    for (const test::NamedTable& sample : test::sample_tables()) {
      SCOPED_TRACE(compiler + " " + sample.name);
      const ExportRequest request{sample.table, "m-kg-s", {}};
      BuildVariant build = c.variants(request)[0];
      build.command[0] = compiler;
      for (const char* flag : {"-Wall", "-Wextra", "-Wpedantic", "-Wconversion", "-Werror"})
        build.command.insert(build.command.begin() + 1, flag);
      const test::States states(sample.table, 20000, 3);
      std::vector<double> tau(states.rows());
      CompiledTarget(c, request, c.generate(request), build)
          .drive(states.rows(), states.columns(), tau);
      EXPECT_LE(test::worst_relative(tau, test::expected(sample.table, states)), 1e-13);
    }
  }
}

TEST(CTarget, CompilesAsOneFileAloneAndIsUsableFromCpp) {
  const Table table = test::four_axis_table();
  const ExportRequest request{table, "mm-t-s", {}};
  SourceBundle bundle = find_exporter("c")->generate(request);
  EXPECT_EQ(bundle.size(), 3u);
  EXPECT_THAT(bundle.at("frictab_tau_R.c"),
              testing::Not(testing::ContainsRegex("malloc|stdio|static double [a-z_0-9]*;")));
  bundle["use.cpp"] = "#include \"frictab_tau_R.h\"\n"
                      "double use() { return frictab_tau_R(1, 1, 1, 1, 1, 1); }\n";
  BuildVariant build;
  build.name = "cpp";
  build.command = {"g++", "-Wall", "-Werror", "-fPIC", "-shared", "-o", "@{out}", "@{dir}/use.cpp"};
  const TemporaryDirectory work;
  EXPECT_NO_THROW(compile_library(bundle, build, work.path()));
}

TEST(CTarget, TellsByBitsWhichAxesAreLeft) {
  const auto outside = four_axes().find<Outside>("frictab_outside");
  EXPECT_EQ(outside(1000, 2, 50, 100, 0, 480), 0u);
  EXPECT_EQ(outside(500, 1, 5, 20, 0, 480), 0u);
  EXPECT_EQ(outside(2750, 20, 500, 200, 0, 480), 0u);
  EXPECT_EQ(outside(499, 2, 50, 100, 0, 480), 1u);
  EXPECT_EQ(outside(1000, 21, 50, 100, 0, 480), 2u);
  EXPECT_EQ(outside(1000, 2, 0, 100, 0, 480), 4u);
  EXPECT_EQ(outside(1000, 2, 50, -inf, 0, 480), 8u);
  EXPECT_EQ(outside(inf, inf, inf, inf, 0, 480), 15u);
}

TEST(CTarget, GivesTheSameBitsInBatchAndTakesNullForWhatItDoesNotUse) {
  const Table table = test::four_axis_table();
  const test::States states(table, 1000, 5);
  const auto& c = states.columns();
  std::vector<double> tau(1000);
  four_axes().find<Batch>("frictab_tau_R_batch")(1000, c[0], c[1], c[2], c[3], nullptr, c[4],
                                                 tau.data());
  const auto entry = four_axes().find<Entry>("frictab_tau_R");
  for (std::size_t i = 0; i < 1000; ++i)
    EXPECT_EQ(tau[i], entry(c[0][i], c[1][i], c[2][i], c[3][i], nan, c[4][i]));
}

TEST(CTarget, GivesNaNForNaNInWhatItUsesOnly) {
  const auto entry = four_axes().find<Entry>("frictab_tau_R");
  for (std::size_t i = 0; i < 6; ++i) {
    double x[] = {1000, 2, 50, 100, 1, 480};
    x[i] = nan;
    EXPECT_EQ(std::isnan(entry(x[0], x[1], x[2], x[3], x[4], x[5])), i != 4) << i;
  }
}

TEST(CTarget, ClampsInfinitiesToTheEdgeOfTheTable) {
  const auto entry = four_axes().find<Entry>("frictab_tau_R");
  EXPECT_EQ(entry(1000, inf, 50, 100, 0, 480), entry(1000, 20, 50, 100, 0, 480));
  EXPECT_EQ(entry(1000, 2, -inf, 100, 0, 480), entry(1000, 2, 5, 100, 0, 480));
  EXPECT_EQ(entry(inf, 2, 50, 100, 0, 480), 0.8 * (0.5773502691896258 * 480));
}

TEST(CTarget, MayRunInThreadsAtOnce) {
  const auto entry = four_axes().find<Entry>("frictab_tau_R");
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

} // namespace

} // namespace frictab
