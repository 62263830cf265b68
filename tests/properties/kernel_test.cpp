// One kernel, many ways to compile and to search: the same bits, nothing read beyond the arrays,
// exact where it must be.
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/kernel_variant.h"
#include "table/axis_search.h"
#include "table/spline.h"

namespace frictab::kernel_test {

using table::axis_search;
using table::AxisSearch;
using table::CellSearch;

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double tiny = std::numeric_limits<double>::denorm_min();

std::uint64_t bits(double x) {
  std::uint64_t out;
  std::memcpy(&out, &x, sizeof out);
  return std::isnan(x) ? 1 : out; // one NaN is as good as another
}

enum class Spacing { even, uneven, crowded };

std::vector<double> nodes(std::size_t count, Spacing spacing, double low = -0.7, double high = 2) {
  std::vector<double> u;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = static_cast<double>(i) / static_cast<double>(count - 1);
    const double place = spacing == Spacing::even     ? w
                         : spacing == Spacing::uneven ? w * (0.4 + 0.6 * w)
                                                      : std::pow(w, 12.0); // no guide resolves it
    u.push_back(i + 1 == count ? high : low + (high - low) * place);
  }
  return u;
}

// Coordinates where something may go wrong, and random ones.
std::vector<double> coordinates(const std::vector<double>& u, Random& random) {
  std::vector<double> out{nan, inf, -inf, 0.0, -0.0, tiny, -tiny, 1e300, -1e300};
  for (const double node : u)
    for (const double x : {node, std::nextafter(node, -inf), std::nextafter(node, inf)})
      out.push_back(x);
  for (int i = 0; i < 500; ++i)
    out.push_back(random.uniform(u.front() - 0.1, u.back() + 0.1));
  return out;
}

TEST(AxisSearch, FindsTheSameCellAndWeightEachWay) {
  Random random(1);
  std::size_t guides = 0, evens = 0, bisections = 0;
  for (const std::size_t count : {2, 3, 4, 9, 17, 40, 257, 3000})
    for (const Spacing spacing : {Spacing::even, Spacing::uneven, Spacing::crowded})
      for (const double offset : {0.0, 1e3, -1e9}) { // far from zero a step is few ulps
        std::vector<double> u = nodes(count, spacing, offset - 0.7, offset + 2);
        u.erase(std::unique(u.begin(), u.end()), u.end());
        if (u.size() < 2) continue;
        const AxisSearch slow = axis_search(u, CellSearch::bisection);
        ASSERT_EQ(slow.scale, 0);
        for (const CellSearch search : {CellSearch::fastest, CellSearch::even, CellSearch::guide}) {
          const AxisSearch fast = axis_search(u, search);
          guides += !fast.guide.empty();
          evens += fast.guide.empty() && fast.scale > 0;
          bisections += !(fast.scale > 0);
          const ft_axis a = slow.axis(1), b = fast.axis(1);
          for (const double x : coordinates(u, random)) {
            int cell[2];
            double weight[2];
            ASSERT_EQ(ft_locate(&a, x, &cell[0], &weight[0]),
                      ft_locate(&b, x, &cell[1], &weight[1]));
            ASSERT_EQ(cell[0], cell[1]) << x;
            ASSERT_EQ(bits(weight[0]), bits(weight[1])) << x;
          }
        }
      }
  EXPECT_GT(guides, 20U);
  EXPECT_GT(evens, 10U);
  EXPECT_GT(bisections, 3U);
}

TEST(AxisSearch, LocatesNodesWithWeightZeroAndTheLastWithOne) {
  for (const Spacing spacing : {Spacing::even, Spacing::uneven, Spacing::crowded}) {
    const AxisSearch search = axis_search(nodes(12, spacing));
    const ft_axis axis = search.axis(1);
    int cell = 0;
    double weight = 0;
    for (int i = 0; i < 12; ++i) {
      EXPECT_EQ(ft_locate(&axis, search.u[static_cast<std::size_t>(i)], &cell, &weight), 0);
      EXPECT_EQ(cell, std::min(i, 10));
      EXPECT_EQ(weight, i == 11 ? 1 : 0);
    }
    EXPECT_EQ(ft_locate(&axis, inf, &cell, &weight), 1);
    EXPECT_EQ(cell, 10);
    EXPECT_EQ(weight, 1);
    EXPECT_EQ(ft_locate(&axis, -inf, &cell, &weight), 1);
    EXPECT_EQ(cell, 0);
    EXPECT_EQ(weight, 0);
    EXPECT_EQ(ft_locate(&axis, nan, &cell, &weight), 0);
    EXPECT_TRUE(std::isnan(weight));
  }
}

TEST(AxisSearch, HoldsOnAxesOfDenormalNumbers) {
  const AxisSearch search = axis_search({0, 3 * tiny, 4 * tiny, 900 * tiny});
  const ft_axis axis = search.axis(1);
  int cell = 0;
  double weight = 0;
  EXPECT_EQ(ft_locate(&axis, 3 * tiny, &cell, &weight), 0);
  EXPECT_EQ(cell, 1);
  EXPECT_EQ(weight, 0);
  ft_locate(&axis, 100 * tiny, &cell, &weight);
  EXPECT_EQ(cell, 2);
  EXPECT_GE(weight, 0);
  EXPECT_LE(weight, 1);
}

TEST(AxisSearch, TakesTheFastestWayThereIs) {
  EXPECT_TRUE(axis_search(nodes(17, Spacing::even)).guide.empty());
  EXPECT_GT(axis_search(nodes(17, Spacing::even)).scale, 0);
  const AxisSearch guided = axis_search(nodes(17, Spacing::uneven));
  EXPECT_FALSE(guided.guide.empty());
  EXPECT_LE(guided.guide.size(), 1025U);
  EXPECT_EQ(axis_search(nodes(200, Spacing::crowded)).scale, 0);
}

// A grid with arrays of exactly the size the kernels may read: a sanitizer sees one more.
struct Grid {
  Grid(const std::vector<std::size_t>& counts, CellSearch search, Spacing spacing) {
    std::size_t size = 1;
    for (const std::size_t count : counts) {
      searches.push_back(axis_search(nodes(count, spacing), search));
      splines.push_back(table::spline_axis(searches.back().u));
      size *= count;
    }
    Random random(5);
    for (std::size_t i = 0; i < size; ++i) {
      single.push_back(static_cast<float>(random.uniform(-1, 2)));
      value.push_back(static_cast<double>(single.back()));
    }
    coefficients = table::spline_coefficients(splines, value);
    coefficients.shrink_to_fit();
    for (double& c : coefficients) { // the same in both types
      single_coefficients.push_back(static_cast<float>(c));
      c = static_cast<double>(single_coefficients.back());
    }
    single.shrink_to_fit();
    single_coefficients.shrink_to_fit();
    value.shrink_to_fit();
    long stride = static_cast<long>(size);
    for (std::size_t a = 0; a < counts.size(); ++a) {
      stride /= static_cast<long>(counts[a]);
      linear.push_back(searches[a].axis(stride));
      cubic.push_back({linear.back(), splines[a].first.data(), splines[a].basis.data()});
    }
  }
  int axes() const { return static_cast<int>(linear.size()); }
  std::vector<AxisSearch> searches;
  std::vector<table::SplineAxis> splines;
  std::vector<ft_axis> linear;
  std::vector<ft_spline_axis> cubic;
  std::vector<double> value, coefficients;
  std::vector<float> single, single_coefficients;
};

std::vector<double> place(const Grid& grid, Random& random) {
  std::vector<double> u;
  for (const AxisSearch& search : grid.searches) {
    const double die = random.uniform();
    const auto node =
        static_cast<std::size_t>(random.uniform() * static_cast<double>(search.u.size()) * 0.999);
    u.push_back(die < 0.2    ? search.u[node]
                : die < 0.22 ? nan
                             : random.uniform(search.u.front() - 0.2, search.u.back() + 0.2));
  }
  return u;
}

// Everything a kernel gives at u, as bits.
std::vector<std::uint64_t> answers(const test::KernelVariant& kernel, const Grid& grid,
                                   const std::vector<double>& u, bool single) {
  std::vector<double> by(u.size());
  unsigned outside[4] = {};
  std::vector<std::uint64_t> out;
  const int axes = grid.axes();
  const ft_values v =
      single ? ft_values{nullptr, grid.single.data()} : ft_values{grid.value.data(), nullptr};
  const ft_values c = single ? ft_values{nullptr, grid.single_coefficients.data()}
                             : ft_values{grid.coefficients.data(), nullptr};
  const auto take = [&](double value) {
    out.push_back(bits(value));
    for (const double one : by)
      out.push_back(bits(one));
  };
  take(kernel.linear(axes, grid.linear.data(), v, u.data(), &outside[0]));
  take(kernel.linear_gradient(axes, grid.linear.data(), v, u.data(), by.data(), &outside[1]));
  std::ranges::fill(by, 0);
  take(kernel.cubic(axes, grid.cubic.data(), c, u.data(), &outside[2]));
  take(kernel.cubic_gradient(axes, grid.cubic.data(), c, u.data(), by.data(), &outside[3]));
  out.insert(out.end(), outside, outside + 4);
  const std::size_t row = u.size() + 1;
  EXPECT_EQ(out[0], out[row]) << "linear value without and with gradient";
  EXPECT_EQ(out[2 * row], out[3 * row]) << "cubic value without and with gradient";
  return out;
}

const std::vector<std::vector<std::size_t>> shapes = {
    {2},       {3},       {7},          {2, 2},          {5, 3},
    {3, 2, 4}, {6, 5, 2}, {4, 3, 2, 5}, {3, 5, 2, 4, 6}, {2, 3, 2, 4, 3, 2}};

TEST(Kernels, GiveTheSameBitsInEveryVariantSearchAndType) {
  std::vector<const test::KernelVariant*> variants{&test::plain_kernel};
  if (test::wide_kernel()) variants.push_back(test::wide_kernel());
  Random random(9);
  for (const auto& counts : shapes)
    for (const Spacing spacing : {Spacing::even, Spacing::uneven}) {
      const Grid slow(counts, CellSearch::bisection, spacing),
          fast(counts, CellSearch::fastest, spacing);
      for (int i = 0; i < 200; ++i) {
        const std::vector<double> u = place(fast, random);
        const auto truth = answers(test::vector_kernel, slow, u, false);
        ASSERT_EQ(answers(test::vector_kernel, fast, u, false), truth);
        ASSERT_EQ(answers(test::vector_kernel, fast, u, true), truth) << "single";
        for (const test::KernelVariant* kernel : variants) {
          ASSERT_EQ(answers(*kernel, fast, u, false), truth) << kernel->name;
          ASSERT_EQ(answers(*kernel, slow, u, true), truth) << kernel->name << " single";
        }
      }
    }
}

TEST(Kernels, MeetTheValuesAtTheNodesBitForBitWhereLinear) {
  for (const auto& counts : shapes) {
    const Grid grid(counts, CellSearch::fastest, Spacing::uneven);
    for (std::size_t i = 0; i < grid.value.size(); ++i) {
      std::vector<double> u(counts.size());
      std::size_t rest = i;
      for (std::size_t d = counts.size(); d-- > 0; rest /= counts[d])
        u[d] = grid.searches[d].u[rest % counts[d]];
      ASSERT_EQ(
          table::interpolate(grid.axes(), grid.linear.data(), grid.value.data(), u.data(), nullptr),
          grid.value[i]);
    }
  }
}

TEST(Kernels, OfSevenAndEightAxesReproduceMultilinearFunctions) {
  for (const std::size_t axes : {7, 8}) {
    Grid grid(std::vector<std::size_t>(axes, 3), CellSearch::fastest, Spacing::uneven);
    const auto field = [](const std::vector<double>& u) {
      double product = 1;
      for (std::size_t d = 0; d < u.size(); ++d)
        product *= 1.5 + u[d] / static_cast<double>(d + 3);
      return product;
    };
    for (std::size_t i = 0; i < grid.value.size(); ++i) {
      std::vector<double> u(axes);
      std::size_t rest = i;
      for (std::size_t d = axes; d-- > 0; rest /= 3)
        u[d] = grid.searches[d].u[rest % 3];
      grid.value[i] = field(u);
    }
    grid.coefficients = table::spline_coefficients(grid.splines, grid.value);
    Random random(axes);
    for (int i = 0; i < 50; ++i) {
      std::vector<double> u(axes), by(axes);
      for (double& x : u)
        x = random.uniform(-0.7, 2);
      const double truth = field(u), bound = 1e-13 * truth;
      const int n = grid.axes();
      const double linear = table::interpolate(n, grid.linear.data(), grid.value.data(), u.data(),
                                               by.data(), nullptr);
      EXPECT_NEAR(linear, truth, bound);
      for (std::size_t d = 0; d < axes; ++d)
        EXPECT_NEAR(by[d], truth / (1.5 * static_cast<double>(d + 3) + u[d]), 10 * bound);
      const double cubic = table::interpolate(n, grid.cubic.data(), grid.coefficients.data(),
                                              u.data(), by.data(), nullptr);
      EXPECT_NEAR(cubic, truth, 100 * bound); // coefficients of 3^8 nodes are solved for
      for (std::size_t d = 0; d < axes; ++d)
        EXPECT_NEAR(by[d], truth / (1.5 * static_cast<double>(d + 3) + u[d]), 1000 * bound);
    }
  }
}

} // namespace
} // namespace frictab::kernel_test
