// What encloses a formula must hold all of its values: bounds, slopes, polynomials with errors.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/random.h"
#include "expr/coordinates.h"
#include "expr/program.h"
#include "expr/sensitivity.h"
#include "proof/taylor_functions.h"
#include "proof/taylor_model.h"

namespace frictab::enclosure_test {

using expr::Bounds;
using expr::Expr;
using expr::Op;
using expr::parse_expr;
using proof::Monomials;
using proof::TaylorProgram;

namespace {

const std::vector<std::string> xy{"x", "y"};

// Every operation, smooth and not, over positive x and y.
const char* const formulas[] = {
    "x*y - 2*x + 3",
    "x/y",
    "exp(-x*y)",
    "log(x + y)",
    "sqrt(x*y + 1)",
    "sin(3*x - y)",
    "tanh(2*x - y) + 0.3*tanh(y)",
    "minimum(x, y*y)",
    "maximum(log(x), -y)",
    "where(x <= y, x*y, y*y)",
    "x**0.3*y**(-1.2)",
    "exp(0.2*tanh(x - 1) - 0.1*tanh(y + x))/(1 + x)",
    "minimum(maximum(0.1*x - 0.05*y, 0)*y, 0.2)",
};

double value(const Expr& formula, double x, double y) {
  return expr::Program(formula, xy, {})(std::vector<double>{x, y}, {});
}

struct Box {
  Bounds x, y;
};

Box random_box(Random& random) {
  const double wide = std::pow(10, random.uniform(-3, 0));
  const double x = random.uniform(0.2, 3), y = random.uniform(0.2, 3);
  return {{x, x + wide}, {y, y + wide * random.uniform()}};
}

TEST(Enclosure, NumbersBeyondTheLargestLeaveAnInterval) {
  const double beyond = HUGE_VAL, largest = std::numeric_limits<double>::max();
  for (const Bounds& range : {expr::outward(beyond, beyond), expr::outward(-beyond, -beyond),
                              expr::outward(-beyond, beyond), expr::outward(largest, beyond)}) {
    EXPECT_LE(range.low, range.high);
    EXPECT_LE(range.low, largest);
    EXPECT_GE(range.high, -largest);
  }
  const Bounds power = expr::apply(Op::power, {250, 312}, {333, 416}, {}, {});
  EXPECT_LE(power.low, largest) << "of values that are too large for a double";
  EXPECT_EQ(power.high, beyond);
}

class SlowEncloseFormula : public testing::TestWithParam<const char*> {};

TEST_P(SlowEncloseFormula, TaylorModelsHoldEveryValueInTheBox) {
  const Expr formula = parse_expr(GetParam());
  for (const bool logarithmic : {false, true}) {
    const std::set<std::string> log_symbols =
        logarithmic ? std::set<std::string>{"x", "y"} : std::set<std::string>{};
    const Expr inner = in_coordinates(formula, log_symbols);
    const Monomials monomials(2, 4);
    const TaylorProgram program(inner, xy, monomials);
    TaylorProgram::Work work(program);
    Random random(5);
    for (int i = 0; i < 200; ++i) {
      const Box box = random_box(random);
      const auto to_u = [&](const Bounds& b) {
        return logarithmic ? Bounds{std::log(b.low), std::log(b.high)} : b;
      };
      const Bounds u[] = {to_u(box.x), to_u(box.y)};
      std::vector<double> c(monomials.size());
      const double error = program(u, work, c);
      ASSERT_TRUE(std::isfinite(error));
      for (int k = 0; k < 40; ++k) {
        const double d[] = {random.uniform(-1, 1), random.uniform(-1, 1)};
        double polynomial = 0, at[2];
        for (std::size_t m = 0; m < monomials.size(); ++m)
          polynomial += c[m] * std::pow(d[0], monomials.exponents(m)[0]) *
                        std::pow(d[1], monomials.exponents(m)[1]);
        for (int v = 0; v < 2; ++v) {
          at[v] = 0.5 * (u[v].low + u[v].high) + 0.5 * d[v] * u[v].width();
          if (logarithmic) at[v] = std::exp(at[v]);
        }
        const double truth = value(formula, at[0], at[1]);
        EXPECT_LE(std::abs(polynomial - truth), error + 1e-13 * (1 + std::abs(truth)))
            << GetParam() << " at " << at[0] << ", " << at[1];
      }
    }
  }
}

TEST_P(SlowEncloseFormula, BoundsAndSlopesHoldBetweenAnyTwoValues) {
  const Expr formula = parse_expr(GetParam());
  if (formula.op() == Op::where_le) return; // it jumps, and says so: below
  const expr::Sensitivity sensitivity(formula, xy, "x");
  Random random(6);
  for (int i = 0; i < 300; ++i) {
    const Box box = random_box(random);
    const Bounds states[] = {box.x, box.y};
    const auto [range, slope] = sensitivity(states);
    for (int k = 0; k < 20; ++k) {
      const double y = random.uniform(box.y.low, box.y.high);
      const double v = random.uniform(box.x.low, box.x.high);
      const double w = random.uniform(box.x.low, box.x.high);
      const double fv = value(formula, v, y), fw = value(formula, w, y);
      EXPECT_GE(fv, range.low);
      EXPECT_LE(fv, range.high);
      const double slack = 1e-13 * (1 + std::abs(fv) + std::abs(fw));
      EXPECT_LE(std::min(slope.low * (v - w), slope.high * (v - w)), fv - fw + slack);
      EXPECT_GE(std::max(slope.low * (v - w), slope.high * (v - w)), fv - fw - slack);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formulas, SlowEncloseFormula, testing::ValuesIn(formulas));

TEST(Enclosure, ErrorFallsWithThePowerOfTheDegree) {
  const Expr formula = parse_expr("exp(0.2*tanh(x - 1) - 0.1*tanh(y + x))");
  for (const std::size_t degree : {std::size_t{3}, std::size_t{5}}) {
    const Monomials monomials(2, degree);
    const TaylorProgram program(formula, xy, monomials);
    TaylorProgram::Work work(program);
    std::vector<double> c(monomials.size());
    double error[2];
    for (int k = 0; k < 2; ++k) {
      const double r = k == 0 ? 0.2 : 0.1;
      const Bounds box[] = {{1 - r, 1 + r}, {0.5 - r, 0.5 + r}};
      error[k] = program(box, work, c);
    }
    EXPECT_GT(std::log2(error[0] / error[1]), static_cast<double>(degree) + 0.8);
  }
}

TEST(Enclosure, WhatHasNoBoundSaysSo) {
  const Monomials monomials(2, 3);
  const Bounds box[] = {{-0.5, 0.5}, {1, 2}};
  std::vector<double> c(monomials.size());
  for (const char* text : {"log(x)", "1/x", "sqrt(x)", "arccos(x)", "y*log(x) + 1"}) {
    const TaylorProgram program(parse_expr(text), xy, monomials);
    TaylorProgram::Work work(program);
    EXPECT_TRUE(std::isinf(program(box, work, c))) << text;
  }
  // The branch that cannot be taken does not matter.
  const TaylorProgram program(parse_expr("where(y <= 3, y, log(x))"), xy, monomials);
  TaylorProgram::Work work(program);
  EXPECT_LT(program(box, work, c), 1e-12);
  const expr::Sensitivity jumps(parse_expr("where(x <= 0, 0, 1)"), xy, "x");
  EXPECT_TRUE(std::isinf(jumps(box).slope.magnitude()));
}

TEST(Enclosure, PowersAreExactInLogarithmicCoordinates) {
  const Expr ln = log_in_coordinates(
      in_coordinates(parse_expr("0.1*maximum(x, 0.01)**0.7*exp(-2*log(y))"), {"x", "y"}));
  const Monomials monomials(2, 2);
  const TaylorProgram program(ln, xy, monomials);
  TaylorProgram::Work work(program);
  std::vector<double> c(monomials.size());
  const Bounds box[] = {{-2, 3}, {0, 4}};
  EXPECT_LT(program(box, work, c), 1e-13);
  EXPECT_NEAR(c[1], 0.7 * 2.5, 1e-14);
  EXPECT_NEAR(c[2], -2 * 2, 1e-14);
}

TEST(Enclosure, ChebyshevFitsStayWithinTheirError) {
  Random random(9);
  for (const Op op : {Op::exp, Op::log, Op::sqrt, Op::sin, Op::tanh, Op::divide})
    for (int i = 0; i < 200; ++i) {
      const double centre = op == Op::sin || op == Op::tanh || op == Op::exp ? random.uniform(-4, 4)
                                                                             : random.uniform(2, 6);
      const double radius = random.uniform(0, 0.9);
      double c[6];
      const double error = proof::chebyshev_fit(op, centre, radius, c);
      for (int k = 0; k <= 50; ++k) {
        const double y = -1 + k / 25.0, x = centre + radius * y;
        const double truth = op == Op::exp    ? std::exp(x)
                             : op == Op::log  ? std::log(x)
                             : op == Op::sqrt ? std::sqrt(x)
                             : op == Op::sin  ? std::sin(x)
                             : op == Op::tanh ? std::tanh(x)
                                              : 1 / x;
        double p = 0;
        for (int n = 6; n-- > 0;)
          p = p * y + c[n];
        EXPECT_LE(std::abs(p - truth), error);
      }
      EXPECT_LT(error, 0.02);
    }
}

} // namespace
} // namespace frictab::enclosure_test
