// Interpolation kernels: exact where they must be, their orders, their derivatives, their edges.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "table/build.h"
#include "table/spline.h"
#include "table/table_file.h"

namespace frictab::spline_test {

using expr::Expr;
using table::Interpolation;
using table::Table;
using table::TableAxis;
using table::TableFunction;

namespace {

using Field = std::function<double(const std::vector<double>&)>;

const char* const names[] = {"sigma_n_MPa", "psi", "v_rel_mm_s", "T_contact_C", "s_mm"};

TableAxis axis_of(std::size_t d, std::vector<double> nodes) {
  TableAxis axis;
  axis.name = names[d];
  axis.nodes = std::move(nodes);
  return axis;
}

// `count` nodes on [1, 2], evenly spaced or denser at the lower end.
std::vector<double> nodes_of(std::size_t count, bool even) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i < count; ++i) {
    const double w = static_cast<double>(i) / static_cast<double>(count - 1);
    nodes.push_back(i + 1 == count ? 2 : 1 + (even ? w : w * (0.6 + 0.4 * w)));
  }
  return nodes;
}

// The field on a grid; tau_R is the interpolated value itself.
Table table_of(const Field& field, std::vector<TableAxis> axes, Interpolation interpolation) {
  Table table;
  table.quantity = models::PieceQuantity::tau_R;
  table.interpolation = interpolation;
  table.axes = std::move(axes);
  table.combine = Expr::symbol("value");
  std::size_t count = 1;
  for (const TableAxis& axis : table.axes)
    count *= axis.nodes.size();
  for (std::size_t i = 0; i < count; ++i)
    table.value.push_back(field(table::values_at(table.axes, i)));
  return table;
}

Table table_of(const Field& field, const std::vector<std::size_t>& counts, bool even,
               Interpolation interpolation) {
  std::vector<TableAxis> axes;
  for (const std::size_t count : counts)
    axes.push_back(axis_of(axes.size(), nodes_of(count, even)));
  return table_of(field, std::move(axes), interpolation);
}

std::vector<double> random_state(Random& random, std::size_t dims) {
  std::vector<double> x(dims);
  for (double& one : x)
    one = random.uniform(1, 2);
  return x;
}

double worst_error(const Field& field, const Table& table, std::size_t samples = 20000) {
  const TableFunction function(table);
  Random random(11);
  double worst = 0;
  for (std::size_t i = 0; i < samples; ++i) {
    const auto x = random_state(random, table.axes.size());
    worst = std::max(worst, std::abs(function(x) - field(x)));
  }
  return worst;
}

// Product over the axes of polynomials of the given degrees, all coefficients at work.
Field polynomial(std::vector<int> degrees) {
  return [degrees](const std::vector<double>& x) {
    double product = 1;
    for (std::size_t d = 0; d < x.size(); ++d) {
      double sum = 0;
      for (int k = degrees[d]; k >= 0; --k)
        sum = sum * x[d] + (k % 2 ? -0.7 : 1.1) * (1 + 0.3 * static_cast<double>(d + 1) * k);
      product *= sum;
    }
    return product;
  };
}

double smooth(const std::vector<double>& x) {
  double phase = 0.3;
  for (std::size_t d = 0; d < x.size(); ++d)
    phase += static_cast<double>(d + 2) * x[d];
  return std::exp(0.5 * std::sin(phase));
}

// Its fourth derivative is nowhere small: orders show on moderate grids.
double reciprocal(const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t d = 0; d < x.size(); ++d)
    sum += static_cast<double>(d + 2) * x[d];
  return 1 / sum;
}

TEST(CubicSpline, ReproducesCubicPolynomialsOfTheCoordinateToRounding) {
  const Field field = polynomial({3, 3, 3});
  for (const bool even : {true, false})
    EXPECT_LT(worst_error(field, table_of(field, {9, 5, 4}, even, Interpolation::cubic)), 1e-11)
        << even;
}

TEST(CubicSpline, IsQuadraticOnThreeNodesAndLinearOnTwo) {
  const Field field = polynomial({1, 2, 3, 2, 1});
  EXPECT_LT(worst_error(field, table_of(field, {2, 3, 4, 3, 2}, false, Interpolation::cubic)),
            1e-11);
  const Field last_cubic = polynomial({2, 1, 3});
  EXPECT_LT(worst_error(last_cubic, table_of(last_cubic, {3, 2, 6}, false, Interpolation::cubic)),
            1e-11);
}

TEST(CubicSpline, MeetsTheNodes) {
  Random random(3);
  const Field rough = [&](const std::vector<double>&) { return random.uniform(-1, 1); };
  for (const std::size_t count : {2, 3, 4, 5, 6, 7, 30}) {
    const Table table = table_of(rough, {count, 5}, false, Interpolation::cubic);
    const TableFunction function(table);
    std::size_t i = 0;
    for (const double x : table.axes[0].nodes)
      for (const double y : table.axes[1].nodes) {
        const std::vector<double> state{x, y};
        EXPECT_NEAR(function(state), table.value[i++], 1e-13) << count;
      }
  }
}

TEST(LinearInterpolation, ReproducesMultilinearFunctionsToRounding) {
  const Field field = polynomial({1, 1, 1, 1});
  EXPECT_LT(worst_error(field, table_of(field, {5, 2, 3, 4}, false, Interpolation::linear)), 1e-12);
}

// By halving the spacing.
double order(Interpolation interpolation, std::size_t dims, bool even) {
  const std::size_t cells = dims < 3 ? 64 : 32;
  const auto error = [&](std::size_t count) {
    const std::vector<std::size_t> counts(dims, count + 1);
    return worst_error(reciprocal, table_of(reciprocal, counts, even, interpolation), 200000);
  };
  return std::log2(error(cells) / error(2 * cells));
}

TEST(CubicSpline, ConvergesWithTheFourthPowerOfTheSpacingInOneToThreeAxes) {
  for (const std::size_t dims : {1, 2, 3})
    for (const bool even : {true, false})
      EXPECT_GT(order(Interpolation::cubic, dims, even), 3.8) << dims << " axes, even " << even;
}

TEST(LinearInterpolation, ConvergesWithTheSquareOfTheSpacingInOneToThreeAxes) {
  for (const std::size_t dims : {1, 2, 3})
    for (const bool even : {true, false})
      EXPECT_GT(order(Interpolation::linear, dims, even), 1.9) << dims << " axes, even " << even;
}

TEST(CubicSpline, HasTwoContinuousDerivatives) {
  const Table table = table_of(smooth, {8}, false, Interpolation::cubic);
  const TableFunction function(table);
  const auto slope = [&](double x) {
    double derivative = 0;
    function.gradient(std::vector<double>{x}, {&derivative, 1});
    return derivative;
  };
  const double h = 1e-6;
  double largest_third = 0; // its third derivative jumps at knots: this is no single polynomial
  for (std::size_t i = 1; i + 1 < table.axes[0].nodes.size(); ++i) {
    const double x = table.axes[0].nodes[i];
    EXPECT_NEAR(slope(x - 1e-9), slope(x + 1e-9), 1e-6);
    const double before = (slope(x - h) - slope(x - 3 * h)) / (2 * h);
    const double behind = (slope(x + 3 * h) - slope(x + h)) / (2 * h);
    EXPECT_NEAR(before, behind, 1e-3 * (1 + std::abs(before)));
    const double wide = 1e-3;
    const auto third = [&](double at) {
      return (slope(at + wide) - 2 * slope(at) + slope(at - wide)) / (wide * wide);
    };
    largest_third = std::max(largest_third, std::abs(third(x + 2 * wide) - third(x - 2 * wide)));
  }
  EXPECT_GT(largest_third, 1);
}

TEST(CubicSpline, BendsAtDeclaredKinksOnly) {
  const Field bent = [](const std::vector<double>& x) { return std::max(x[0], 1.3) * x[1]; };
  std::vector<TableAxis> axes = {axis_of(0, {1, 1.15, 1.3, 1.5, 1.7, 2}), axis_of(1, {1, 2})};
  EXPECT_GT(worst_error(bent, table_of(bent, axes, Interpolation::cubic)), 1e-2);
  axes[0].kinks = {1.3};
  EXPECT_LT(worst_error(bent, table_of(bent, axes, Interpolation::cubic)), 1e-13);
  // A piece of one cell at either end.
  axes[0] = axis_of(0, {1, 1.3, 1.5, 1.7, 2});
  axes[0].kinks = {1.3};
  EXPECT_LT(worst_error(bent, table_of(bent, axes, Interpolation::cubic)), 1e-13);
  const Field late = [](const std::vector<double>& x) { return std::max(x[0], 1.7) * x[1]; };
  axes[0].kinks = {1.7};
  EXPECT_LT(worst_error(late, table_of(late, axes, Interpolation::cubic)), 1e-13);
}

class Gradient : public testing::TestWithParam<Interpolation> {};

TEST_P(Gradient, IsTheCentralDifferenceOfTheValueWhichIsTheSameBits) {
  for (std::size_t dims = 1; dims <= 5; ++dims) {
    Table table = table_of(smooth, std::vector<std::size_t>(dims, 6), false, GetParam());
    table.log_value = true; // exp of the field, times a state that is no axis, limited
    for (double& value : table.value)
      value = std::exp(value);
    for (std::size_t d = 0; d < dims; d += 2)
      table.axes[d].log = true;
    table.combine = minimum(Expr::symbol("value") * sqrt(Expr::symbol("sigma_f_MPa")),
                            0.9 * Expr::symbol("sigma_f_MPa"));
    const TableFunction function(table);
    Random random(dims);
    for (int i = 0; i < 300; ++i) {
      auto x = random_state(random, dims);
      x.push_back(random.uniform(3, 8));
      std::vector<double> derivative(x.size());
      EXPECT_EQ(function.gradient(x, derivative), function(x));
      for (std::size_t d = 0; d < x.size(); ++d) {
        const double h = 1e-6;
        auto low = x, high = x;
        low[d] -= h;
        high[d] += h;
        bool smooth_here = true; // no node of a linear table, no edge, no limit in between
        for (std::size_t k = 0; d < dims && k < table.axes[d].nodes.size(); ++k)
          smooth_here = smooth_here && std::abs(table.axes[d].nodes[k] - x[d]) > 2 * h;
        const double difference = (function(high) - function(low)) / (2 * h);
        if (!smooth_here) continue;
        EXPECT_NEAR(derivative[d], difference, 2e-8 * (1 + std::abs(difference)))
            << dims << " axes, by " << d;
      }
    }
  }
}

TEST_P(Gradient, IsZeroByAnAxisThatIsClampedAndNaNForNaN) {
  Table table = table_of(smooth, {5, 5}, true, GetParam());
  table.axes[0].log = true;
  const TableFunction function(table);
  std::vector<double> derivative(2);
  unsigned outside = 0;
  function.gradient(std::vector<double>{0, 1.5}, derivative, &outside);
  EXPECT_EQ(outside, 1U);
  EXPECT_EQ(derivative[0], 0);
  EXPECT_NE(derivative[1], 0);
  EXPECT_TRUE(std::isnan(function.gradient(std::vector<double>{1.5, std::nan("")}, derivative)));
  EXPECT_TRUE(std::isnan(derivative[0]) && std::isnan(derivative[1]));
}

TEST_P(Gradient, OutsideTheValueIsTheNearestEdges) {
  const Table table = table_of(smooth, {6, 5, 4}, false, GetParam());
  const TableFunction function(table);
  unsigned outside = 0;
  EXPECT_EQ(function(std::vector<double>{1.4, 7, -3}, &outside),
            function(std::vector<double>{1.4, 2, 1}));
  EXPECT_EQ(outside, 6U);
  function(std::vector<double>{2, 1, 1}, &outside);
  EXPECT_EQ(outside, 0U);
  EXPECT_TRUE(std::isnan(function(std::vector<double>{1.4, 1.5, std::nan("")})));
}

INSTANTIATE_TEST_SUITE_P(Kernels, Gradient, testing::ValuesIn(table::grid_interpolations),
                         [](const auto& given) { return table::interpolation_name(given.param); });

TEST(CubicSpline, OvershootsButTauDoesNotLeaveZeroToK) {
  const Field cliff = [](const std::vector<double>& x) {
    return x[0] + 0.5 * x[1] < 2.2 ? 0. : 9.;
  };
  Table table = table_of(cliff, {12, 12}, true, Interpolation::cubic);
  const auto extremes = [&] {
    const TableFunction function(table);
    Random random(2);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < 20000; ++i) {
      auto x = random_state(random, 2);
      if (function.inputs().size() == 3) x.push_back(9 / 0.577);
      low = std::min(low, function(x));
      high = std::max(high, function(x));
    }
    return std::pair{low, high};
  };
  EXPECT_LT(extremes().first, -0.1);
  EXPECT_GT(extremes().second, 9.1);
  table.combine = minimum(maximum(Expr::symbol("value"), 0.0), 0.577 * Expr::symbol("sigma_f_MPa"));
  EXPECT_EQ(extremes().first, 0);
  EXPECT_DOUBLE_EQ(extremes().second, 9);
}

TEST(CubicSpline, OfAFileIsTheSameBitsKinksIncluded) {
  Table table = table_of(smooth, {6, 4}, false, Interpolation::cubic);
  table.axes[0].unit = "MPa";
  table.axes[1].unit = "1";
  table.axes[0].kinks = {table.axes[0].nodes[2]};
  const test::TemporaryDirectory directory;
  table::write_table(table, directory.path("t.h5"));
  const Table again = table::read_table(directory.path("t.h5"));
  EXPECT_EQ(again.interpolation, Interpolation::cubic);
  EXPECT_EQ(again.value, table.value);
  EXPECT_EQ(again.axes[0].kinks, table.axes[0].kinks);
  const TableFunction a(table), b(again);
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const auto x = random_state(random, 2);
    EXPECT_EQ(a(x), b(x));
  }
}

} // namespace
} // namespace frictab::spline_test
