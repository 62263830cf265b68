// Splines and surfaces as effects: through their knots, smooth, straight where nothing bends them.
#include <cmath>

#include <gtest/gtest.h>

#include "effects/natural_spline.h"
#include "expr/program.h"
#include "trace/columns/shapes.h"

#include <Eigen/Dense>

namespace frictab::smooth_forms_test {

using effects::find_effect;
using effects::PlacedEffect;
using effects::spline_knots;
using effects::spline_roughness;

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::vector<std::vector<double>> some_knots = {
    {0, 1},
    {2, 3, 7},
    {0, 0.6, 1.1, 3.5, 9, 9.8, 15, 20},
    {1e-6, 3e-6, 4e-6, 1e-5},
    {-50, -49, 0, 400, 1000},
};

std::vector<double> some_values(std::size_t count) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k)
    values.push_back(0.3 * std::sin(2.3 * static_cast<double>(k * k) + 0.4));
  return values;
}

// By the dense system of its moments and the cubic between two of them.
double direct(const std::vector<double>& knots, const std::vector<double>& values, double x) {
  const auto n = static_cast<Index>(knots.size());
  MatrixXd system = MatrixXd::Identity(n, n);
  VectorXd right = VectorXd::Zero(n);
  const auto at = [](const std::vector<double>& list, Index i) {
    return list[static_cast<std::size_t>(i)];
  };
  for (Index i = 1; i + 1 < n; ++i) {
    const double a = at(knots, i) - at(knots, i - 1), b = at(knots, i + 1) - at(knots, i);
    system.row(i).setZero();
    system(i, i - 1) = a;
    system(i, i) = 2 * (a + b);
    system(i, i + 1) = b;
    right(i) =
        6 * ((at(values, i + 1) - at(values, i)) / b - (at(values, i) - at(values, i - 1)) / a);
  }
  const VectorXd m = system.partialPivLu().solve(right);
  x = std::clamp(x, knots.front(), knots.back());
  Index j = 0;
  while (j + 2 < n && x > at(knots, j + 1))
    ++j;
  const double h = at(knots, j + 1) - at(knots, j), p = at(knots, j + 1) - x, q = x - at(knots, j);
  return m(j) * p * p * p / (6 * h) + m(j + 1) * q * q * q / (6 * h) +
         (at(values, j) / h - m(j) * h / 6) * p + (at(values, j + 1) / h - m(j + 1) * h / 6) * q;
}

PlacedEffect spline(const std::vector<double>& knots, std::vector<double> values) {
  PlacedEffect effect;
  effect.form = find_effect("spline");
  effect.inputs = {{"s_mm", {}, knots.front(), knots.back(), knots}};
  effect.parameters = std::move(values);
  return effect;
}

double factor(const PlacedEffect& effect, std::vector<double> row) {
  return effects::factor_program(effect)(row, effect.parameters);
}

TEST(SmoothForms, SplineIsTheNaturalOneThroughItsKnots) {
  for (const auto& knots : some_knots) {
    const auto values = some_values(knots.size());
    const PlacedEffect effect = spline(knots, values);
    for (std::size_t k = 0; k < knots.size(); ++k)
      EXPECT_NEAR(factor(effect, {knots[k]}), 1 + values[k], 1e-15);
    for (int i = -10; i <= 410; ++i) {
      const double x = knots.front() + (knots.back() - knots.front()) * i / 400;
      EXPECT_NEAR(factor(effect, {x}), 1 + direct(knots, values, x), 1e-12) << x;
    }
  }
}

TEST(SmoothForms, SplineOfValuesOnALineIsThatLine) {
  for (const auto& knots : some_knots) {
    std::vector<double> values;
    for (const double knot : knots)
      values.push_back(0.1 + 0.2 * (knot - knots[0]) / (knots.back() - knots[0]));
    const PlacedEffect effect = spline(knots, values);
    for (int i = 0; i <= 50; ++i)
      EXPECT_NEAR(factor(effect, {knots[0] + (knots.back() - knots[0]) * i / 50}), 1.1 + 0.004 * i,
                  1e-14);
  }
}

TEST(SmoothForms, SlopeOfASplineHasNoJumpAtItsKnots) {
  for (const auto& knots : some_knots) {
    const PlacedEffect effect = spline(knots, some_values(knots.size()));
    const expr::Program program = effects::factor_program(effect);
    for (std::size_t k = 1; k + 1 < knots.size(); ++k) {
      double slope[3], row[1];
      for (const int side : {-1, 0, 1}) {
        row[0] = knots[k] + side * 1e-9 * (knots.back() - knots.front());
        program.gradient(row, effect.parameters, std::span(slope).subspan(side + 1, 1));
      }
      EXPECT_NEAR(slope[0] / slope[1], 1, 1e-4);
      EXPECT_NEAR(slope[2] / slope[1], 1, 1e-4);
    }
  }
}

TEST(SmoothForms, KnotsAreDifferentQuantiles) {
  std::vector<double> values;
  for (int i = 0; i <= 700; ++i)
    values.push_back(i * i);
  EXPECT_EQ(spline_knots(values, 8),
            (std::vector<double>{0, 10000, 40000, 90000, 160000, 250000, 360000, 490000}));
  EXPECT_EQ(spline_knots(std::vector<double>{3, 1, 2, 2, 2, 2, 2, 2, 2, 3, 1}, 8),
            (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(spline_knots(std::vector<double>{0, 1e-4, 5, 10}, 8), (std::vector<double>{0, 5, 10}));
  EXPECT_EQ(spline_knots(std::vector<double>{4, 4, NAN}, 8), (std::vector<double>{4}));
}

PlacedEffect surface(const std::vector<double>& x, const std::vector<double>& y) {
  PlacedEffect effect;
  effect.form = find_effect("surface");
  effect.inputs = {{"s_mm", {}, x.front(), x.back(), x}, {"humidity", {}, y.front(), y.back(), y}};
  effect.parameters.assign(x.size() * y.size(), 0.0);
  return effect;
}

TEST(SmoothForms, SurfaceOfAProductIsTheProductOfTwoSplines) {
  const auto &x = some_knots[2], &y = some_knots[4];
  const auto a = some_values(x.size()), b = some_values(y.size());
  PlacedEffect effect = surface(x, y);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < y.size(); ++j)
      effect.parameters[i * y.size() + j] = a[i] * b[j];
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) {
      const double at = x[0] + (x.back() - x[0]) * i / 20, on = y[0] + (y.back() - y[0]) * j / 20;
      EXPECT_NEAR(factor(effect, {at, on}), 1 + direct(x, a, at) * direct(y, b, on), 1e-12);
    }
}

TEST(SmoothForms, EachLevelHasItsOwnSpline) {
  const auto& knots = some_knots[4];
  PlacedEffect effect;
  effect.form = find_effect("spline_by_level");
  effect.inputs = {{"tool", {"A", "B", "C"}}, {"s_mm", {}, knots.front(), knots.back(), knots}};
  effect.parameters = some_values(3 * knots.size());
  for (std::size_t level = 0; level < 3; ++level) {
    const std::vector<double> own(
        effect.parameters.begin() + static_cast<long>(level * knots.size()),
        effect.parameters.begin() + static_cast<long>((level + 1) * knots.size()));
    for (const double x : {-60.0, -49.7, -3.0, 120.0, 700.0, 2000.0})
      EXPECT_NEAR(factor(effect, {static_cast<double>(level), x}), 1 + direct(knots, own, x),
                  1e-12);
  }
}

MatrixXd matrix(const std::vector<double>& rows) {
  const auto n = std::lround(std::sqrt(rows.size()));
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      rows.data(), n, n);
}

TEST(SmoothForms, RoughnessIsTheIntegralOfTheSquaredSecondDerivative) {
  for (const auto& knots : some_knots) {
    const auto values = some_values(knots.size());
    constexpr int steps = 20000;
    double integral = 0;
    for (int i = 1; i < steps; ++i) {
      const auto f = [&](int at) {
        return direct(knots, values, knots[0] + (knots.back() - knots[0]) * at / steps);
      };
      const double bend = (f(i - 1) - 2 * f(i) + f(i + 1)) * steps * steps;
      integral += bend * bend / steps;
    }
    const VectorXd v = Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
    const double rough = v.dot(matrix(spline_roughness(knots)) * v);
    EXPECT_NEAR(rough, integral, 2e-3 * rough + 1e-9);
  }
}

TEST(SmoothForms, PenaltiesHaveAMeanDiagonalOfOneAndNoNegativeEigenvalue) {
  PlacedEffect by_level = surface(some_knots[2], some_knots[4]);
  by_level.form = find_effect("spline_by_level");
  by_level.inputs[0] = {"tool", {"A", "B", "C"}};
  by_level.parameters.assign(15, 0.0);
  for (const PlacedEffect& effect :
       {spline(some_knots[2], some_values(8)), surface(some_knots[2], some_knots[4]), by_level}) {
    const MatrixXd penalty = matrix(effect.form->penalty(effect));
    const auto n = static_cast<Index>(effects::amplitudes_of(effect));
    ASSERT_EQ(penalty.rows(), n);
    EXPECT_NEAR(penalty.trace() / static_cast<double>(n), 1.001, 1e-12);
    EXPECT_LT((penalty - penalty.transpose()).norm(), 1e-12);
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(penalty).eigenvalues()(0), 0.999e-3);
  }
}

TEST(SmoothForms, PenaltyOfASurfaceAddsBothDirections) {
  const auto &x = some_knots[1], &y = some_knots[2];
  const auto a = some_values(x.size());
  // Bends along x alone: the roughness of that curve, once per knot of y.
  VectorXd v(static_cast<Index>(x.size() * y.size())), w(static_cast<Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i) {
    w(static_cast<Index>(i)) = a[i];
    for (std::size_t j = 0; j < y.size(); ++j)
      v(static_cast<Index>(i * y.size() + j)) = a[i];
  }
  const double all =
      v.dot(matrix(effects::tensor_roughness({spline_roughness(x), spline_roughness(y)})) * v);
  EXPECT_NEAR(all, w.dot(matrix(spline_roughness(x)) * w) * static_cast<double>(y.size()),
              1e-9 * all);
}

TEST(SmoothForms, BasisOfASplineSumsToOneAndGivesTheFactor) {
  const PlacedEffect effect = spline(some_knots[2], some_values(8));
  const VectorXd x = VectorXd::LinSpaced(41, -2, 22);
  const MatrixXd basis = trace::amplitude_basis(effect, {{"s_mm", x}});
  ASSERT_EQ(basis.cols(), 8);
  const VectorXd v = Eigen::Map<const VectorXd>(effect.parameters.data(), 8);
  for (Index i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(basis.row(i).sum(), 1, 1e-14);
    EXPECT_NEAR(1 + basis.row(i).dot(v), factor(effect, {x(i)}), 1e-14);
  }
}

TEST(SmoothForms, SayWhatTheyAre) {
  PlacedEffect effect = spline({0, 5, 20}, {0, 0.1, -0.05});
  EXPECT_EQ(effects::effect_text(effect),
            "natural cubic spline of s_mm through (0, 1), (5, 1.1), (20, "
            "0.95); acts on mu");
  effect.acts_on = effects::ActsOn::tau;
  EXPECT_EQ(effects::formula_text(effect), "tau_R + 1 MPa (spline(x))");
}

} // namespace
} // namespace frictab::smooth_forms_test
