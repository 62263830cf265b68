// Bounds of what single precision does to a formula.
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "expr/rounding.h"

namespace frictab::rounding_test {

using expr::bound_in_single;
using expr::Expr;

namespace {

const Expr x = Expr::symbol("x"), y = Expr::symbol("y");

double error_of(const Expr& formula, double low, double high) {
  return bound_in_single(formula, {{"x", {{low, high}}}, {"y", {{low, high}}}}).error;
}

TEST(RoundingInSingle, OfTheArgumentIsHalfAUnitInTheLastPlaceAndMoreWhereTermsCancel) {
  EXPECT_NEAR(error_of(x, 500, 1000), 1000 * 0x1p-24, 1e-9);
  EXPECT_GT(error_of((1000.0 + x) - 1000.0, 1e-3, 2e-3), 1e-5);
  EXPECT_LT(error_of(maximum(x, 400), 500, 1000), 1001 * 0x1p-24)
      << "the other operand is never it";
}

TEST(RoundingInSingle, IsNotKnownWhereFloatMayOverflowBranchOtherwiseOrLeaveADomain) {
  EXPECT_TRUE(std::isinf(error_of(exp(x), 1, 89)));
  EXPECT_FALSE(std::isinf(error_of(exp(x), 1, 88)));
  EXPECT_TRUE(std::isinf(error_of(where_le(x, 700, x, 2 * x), 500, 1000)));
  EXPECT_FALSE(std::isinf(error_of(where_le(x, 1001, x, 2 * x), 500, 1000)));
  EXPECT_TRUE(std::isinf(error_of(log(x - 1), 1, 2)));
  EXPECT_TRUE(std::isinf(error_of(1 / (x - y), 1, 2)));
}

struct Operation {
  Expr formula;
  double (*exact)(double, double);
  float (*single)(float, float);
};

TEST(RoundingInSingle, BoundsEveryOperation) {
  const Operation operations[] = {
      {x + y, [](double a, double b) { return a + b; }, [](float a, float b) { return a + b; }},
      {x - y, [](double a, double b) { return a - b; }, [](float a, float b) { return a - b; }},
      {x * y, [](double a, double b) { return a * b; }, [](float a, float b) { return a * b; }},
      {x / y, [](double a, double b) { return a / b; }, [](float a, float b) { return a / b; }},
      {pow(x, y), [](double a, double b) { return std::pow(a, b); },
       [](float a, float b) { return std::pow(a, b); }},
      {exp(x), [](double a, double) { return std::exp(a); },
       [](float a, float) { return std::exp(a); }},
      {log(x), [](double a, double) { return std::log(a); },
       [](float a, float) { return std::log(a); }},
      {sqrt(x), [](double a, double) { return std::sqrt(a); },
       [](float a, float) { return std::sqrt(a); }},
      {sin(x), [](double a, double) { return std::sin(a); },
       [](float a, float) { return std::sin(a); }},
      {tanh(x), [](double a, double) { return std::tanh(a); },
       [](float a, float) { return std::tanh(a); }},
      {acos(x), [](double a, double) { return std::acos(a); },
       [](float a, float) { return std::acos(a); }},
      {minimum(x, y), [](double a, double b) { return std::min(a, b); },
       [](float a, float b) { return std::min(a, b); }}};
  Random random(3);
  for (const Operation& operation : operations) {
    const double bound = error_of(operation.formula, 0.1, 0.9);
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
      const double a = random.uniform(0.1, 0.9), b = random.uniform(0.1, 0.9);
      const float found = operation.single(static_cast<float>(a), static_cast<float>(b));
      largest = std::max(largest, std::abs(found - operation.exact(a, b)));
    }
    EXPECT_LE(largest, bound) << to_text(operation.formula);
    EXPECT_GE(largest, 0.01 * bound) << to_text(operation.formula);
  }
}

} // namespace

} // namespace frictab::rounding_test
