// The grid of a solver's own table: made to its aim, in plain coordinates, within a stated size.
#include <cmath>

#include <gtest/gtest.h>

#include "codegen/native_grid.h"
#include "core/random.h"

namespace frictab::native_grid_test {

using codegen::make_native_grid;
using codegen::NativeGrid;
using codegen::NativeProblem;

namespace {

constexpr double k_MPa = 277; // shear limit of the law below

// A power law of pressure and speed with a kink across both.
double law(double p, double v) {
  const double mu = 0.12 * std::pow(p / 1000, -0.3) * (1 - 0.02 * std::log(v));
  return std::min(mu * p, 40 + 0.06 * p);
}

NativeProblem problem() {
  NativeProblem out;
  out.axes = {{"sigma_n_MPa", {"MPa"}, 500, 2750, true}, {"v_rel_mm_s", {"mm/s"}, 5, 500, true}};
  out.pressure = 0;
  out.tau = [](std::size_t rows, auto columns, auto tau) {
    for (std::size_t i = 0; i < rows; ++i)
      tau[i] = law(columns[0][i], columns[1][i]);
  };
  return out;
}

double worst(const NativeGrid& grid, double limit = HUGE_VAL) {
  Random random(3);
  double out = 0;
  for (int i = 0; i < 100000; ++i) {
    const double x[] = {random.uniform(500, 2750), random.uniform(5, 500)};
    out = std::max(out, std::abs(std::min(x[0] * grid.values.at(x), limit) -
                                 std::min(law(x[0], x[1]), limit)));
  }
  return out;
}

TEST(NativeGrid, MeetsItsAimBetweenItsNodesAlsoAcrossAKink) {
  for (const double aim : {5.0, 1.0, 0.2}) {
    const NativeGrid grid = make_native_grid(problem(), {aim});
    EXPECT_TRUE(grid.met);
    EXPECT_LE(grid.found_MPa, aim);
    EXPECT_LE(worst(grid), 1.05 * aim) << "what 100,000 states find beyond the 80,000 of its check";
    EXPECT_GE(grid.found_MPa, 0.5 * aim) << "not finer than asked";
  }
}

TEST(NativeGrid, TakesFewerValuesForALargerAim) {
  const std::size_t coarse = make_native_grid(problem(), {2.0}).values.value.size();
  const std::size_t fine = make_native_grid(problem(), {0.2}).values.value.size();
  EXPECT_LT(2 * coarse, fine);
}

TEST(NativeGrid, SaysHowFarItIsOffWhereTheMostValuesDoNotDo) {
  const NativeGrid grid = make_native_grid(problem(), {0.2, 30});
  EXPECT_FALSE(grid.met);
  EXPECT_LE(grid.values.value.size(), 30u);
  EXPECT_GT(grid.found_MPa, 0.2);
  EXPECT_NEAR(worst(grid), grid.found_MPa, 0.05 * grid.found_MPa);
}

TEST(NativeGrid, LeavesOutAColumnThatDoesNotMatterUnlessTheFormNeedsIt) {
  NativeProblem coulomb = problem();
  coulomb.tau = [](std::size_t rows, auto columns, auto tau) {
    for (std::size_t i = 0; i < rows; ++i)
      tau[i] = 0.08 * columns[0][i];
  };
  NativeGrid grid = make_native_grid(coulomb, {0.5});
  EXPECT_TRUE(grid.values.nodes[0].empty());
  EXPECT_TRUE(grid.values.nodes[1].empty());
  EXPECT_EQ(grid.values.value, std::vector<double>{0.08});
  for (codegen::NativeAxis& axis : coulomb.axes)
    axis.fewest = 2;
  grid = make_native_grid(coulomb, {0.5});
  EXPECT_EQ(grid.values.nodes[0], (std::vector<double>{500, 2750}));
  EXPECT_EQ(grid.values.value, std::vector<double>(4, 0.08));
}

TEST(NativeGrid, ALimitOfTheSolverTakesTheKinkOutOfTheTable) {
  NativeProblem limited = problem(), within = problem();
  limited.tau = [](std::size_t rows, auto columns, auto tau) {
    for (std::size_t i = 0; i < rows; ++i)
      tau[i] = 0.15 * columns[0][i];
  };
  limited.limit_MPa = k_MPa;
  EXPECT_EQ(make_native_grid(limited, {0.5}).values.value, std::vector<double>{0.15});
  within.tau = [](std::size_t rows, auto columns, auto tau) {
    for (std::size_t i = 0; i < rows; ++i)
      tau[i] = std::min(0.15 * columns[0][i], k_MPa);
  };
  EXPECT_GT(make_native_grid(within, {0.5}).values.value.size(), 3u);
}

TEST(NativeGrid, NodesAreInTheSolversUnitAndShortToWrite) {
  NativeProblem si = problem();
  si.axes[0].unit = {"Pa", 1, 1e6};
  si.axes[1].unit = {"m/s", 1000, 1};
  const NativeGrid grid = make_native_grid(si, {0.5});
  EXPECT_EQ(grid.values.nodes[0].front(), 500e6);
  EXPECT_EQ(grid.values.nodes[1].back(), 0.5);
  for (const auto& nodes : grid.values.nodes)
    for (const double x : nodes)
      EXPECT_EQ(codegen::as_written(x), x);
  for (const double x : grid.values.value)
    EXPECT_EQ(codegen::as_written(x), x);
}

TEST(NativeValues, AreLinearBetweenNodesConstantBeyondTheEndsAndNaNForNaN) {
  const codegen::NativeValues values{{{1, 3}, {}, {10, 20, 40}}, {1, 2, 3, 4, 5, 6}, std::nullopt};
  const auto at = [&](double a, double b, double c) {
    const double x[] = {a, b, c};
    return values.at(x);
  };
  EXPECT_EQ(at(1, 0, 10), 1);
  EXPECT_EQ(at(3, 0, 10), 2) << "the first column varies fastest";
  EXPECT_EQ(at(1, 0, 20), 3);
  EXPECT_EQ(at(2, 0, 30), 4.5);
  EXPECT_EQ(at(-9, 7, 99), 5);
  EXPECT_EQ(at(HUGE_VAL, 0, -HUGE_VAL), 2);
  EXPECT_TRUE(std::isnan(at(std::nan(""), 0, 10)));
  EXPECT_TRUE(std::isnan(at(1, std::nan(""), 10)));
}

} // namespace
} // namespace frictab::native_grid_test
