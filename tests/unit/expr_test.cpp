// Formulas: text, parsing, evaluation, derivatives.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"
#include "expr/program.h"
#include "support/refusal.h"

namespace frictab::expr_test {

using expr::BoundProgram;
using expr::Expr;
using expr::parse_expr;
using expr::to_text;

namespace {

double at(const std::string& text, double x, double y = 0) {
  const expr::Program program(parse_expr(text), {"x", "y"}, {});
  const std::vector<double> row{x, y};
  return program(row, {});
}

TEST(Expr, ParsesThePrecedenceOfPython) {
  EXPECT_EQ(at("2 + 3*x**2", 2), 14);
  EXPECT_EQ(at("-x**2", 3), -9);
  EXPECT_EQ(at("2**-x", 1), 0.5);
  EXPECT_EQ(at("x - y - 1", 10, 2), 7);
  EXPECT_EQ(at("x/y/2", 12, 3), 2);
  EXPECT_EQ(at("2**x**y", 3, 2), 512);
  EXPECT_EQ(at("(x - y)*(x + y)", 3, 2), 5);
}

TEST(Expr, EvaluatesEveryFunction) {
  EXPECT_EQ(at("minimum(x, y)", 1, 2), 1);
  EXPECT_EQ(at("maximum(x, y)", 1, 2), 2);
  EXPECT_EQ(at("where(x <= y, x + 10, y + 20)", 1, 2), 11);
  EXPECT_EQ(at("where(x <= y, x + 10, y + 20)", 3, 2), 22);
  EXPECT_EQ(at("exp(log(x))*sqrt(y)", 5, 4), std::exp(std::log(5.0)) * 2);
  EXPECT_EQ(at("sin(y) + arccos(0.5)", 1, 2), std::sin(2) + std::acos(0.5));
  EXPECT_NEAR(at("tanh(x)", 1), std::tanh(1), 3e-16);
}

TEST(Expr, TextKeepsTheTreeSoThatBitsAreKept) {
  for (const char* text : {"x*(y*2)", "(x + y) + 1", "x + (y + 1)", "x/(y/2)", "(-x)**2", "-(x**2)",
                           "2**(-x)", "(2**x)**y", "x - (y - 1)", "(x*y)/3 + 0.1", "1e-20*x"}) {
    const Expr e = parse_expr(text);
    EXPECT_EQ(to_text(parse_expr(to_text(e))), to_text(e)) << text;
    EXPECT_EQ(at(to_text(e), 1.7, 0.3), at(text, 1.7, 0.3)) << text;
  }
}

TEST(Expr, FaultsNameTheColumn) {
  const auto message = [](const char* text) {
    return test::refusal([&] { parse_expr(text, "table.h5"); });
  };
  EXPECT_EQ(message("1 + "),
            "table.h5:1:5: error: the formula ends too early in the formula '1 + '");
  EXPECT_EQ(message("minimun(x, 2)"),
            "table.h5:1:8: error: unknown function 'minimun' in the formula 'minimun(x, 2)'\n"
            "  hint: did you mean 'minimum'?");
  EXPECT_EQ(message("x y"), "table.h5:1:3: error: unexpected 'y' in the formula 'x y'");
  EXPECT_EQ(message("(x"), "table.h5:1:3: error: expected ')' in the formula '(x'");
}

TEST(Expr, DeepNestingIsRefusedInsteadOfOverflowingTheStack) {
  EXPECT_THROW(parse_expr(std::string(100000, '(') + "x"), InputError);
  EXPECT_THROW(parse_expr(std::string(100000, '-') + "x"), InputError);
}

TEST(Expr, NaNGoesThroughMinimumMaximumAndWhere) {
  const double nan = std::nan("");
  for (const char* text : {"minimum(x, y)", "minimum(y, x)", "maximum(x, y)", "maximum(y, x)",
                           "where(x <= y, 1, 2)", "where(y <= x, 1, 2)"})
    EXPECT_TRUE(std::isnan(at(text, nan, 1))) << text;
}

// Units in the last place between tanh(x) and what a formula makes of it.
double tanh_error(double x) {
  const long double exact = std::tanh(static_cast<long double>(x));
  const double size = std::abs(static_cast<double>(exact));
  const double unit = std::nextafter(size, 2.0) - size;
  return static_cast<double>(std::abs(at("tanh(x)", x) - exact)) / unit;
}

TEST(Expr, TanhIsWithinThreeUnitsInTheLastPlace) {
  for (int i = -9000; i <= 9000; ++i) {
    const double x = 0.002500001 * i;
    EXPECT_LE(tanh_error(x), 3) << x;
  }
  for (int digits = 1; digits <= 300; ++digits) {
    const double tiny = 1.7 * std::pow(10.0, -digits);
    EXPECT_LE(tanh_error(tiny), 3) << tiny;
  }
}

TEST(Expr, TanhAtItsEnds) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(at("tanh(x)", infinite), 1);
  EXPECT_EQ(at("tanh(x)", -infinite), -1);
  EXPECT_EQ(at("tanh(x)", 1e300), 1);
  EXPECT_EQ(at("tanh(x)", 0.0), 0);
  EXPECT_TRUE(std::signbit(at("tanh(x)", -0.0)));
  EXPECT_TRUE(std::isnan(at("tanh(x)", std::nan(""))));
}

TEST(Program, SweepGivesTheSameBitsAsSingleRows) {
  const Expr formula =
      parse_expr("minimum(a*exp(-x/b), c)*where(y <= 1, y, log(y) + 1) + tanh(x - a)");
  const expr::Program program(formula, {"x", "y"}, {"a", "b", "c"});
  std::vector<double> x, y;
  for (int i = 0; i < 1000; ++i) {
    x.push_back(0.01 * i);
    y.push_back(0.002 * i);
  }
  const std::vector<const double*> columns{x.data(), y.data()};
  const std::vector<double> scalars{2.0, 3.0, 1.5};
  std::vector<double> batch(1000);
  program.evaluate(1000, columns, scalars, batch.data());
  const BoundProgram bound(program, 1000, columns);
  bound.sweep(scalars, true, [&](const BoundProgram::Block& block) {
    for (std::size_t i = 0; i < block.count; ++i) {
      const std::vector<double> row{x[block.first + i], y[block.first + i]};
      EXPECT_EQ(block.value[i], program(row, scalars));
      EXPECT_EQ(block.value[i], batch[block.first + i]);
    }
  });
}

TEST(Program, DerivativesOfEveryOperationAgreeWithCentralDifferences) {
  const char* formulas[] = {"a + b*x",
                            "a - x*b",
                            "a*b*x",
                            "x/(a + b)",
                            "a**b*x",
                            "x**a + b",
                            "exp(a*x) + b",
                            "log(a + b*x)",
                            "sqrt(a + b*x)",
                            "sin(a*x + b)",
                            "tanh(a*x)*b",
                            "arccos(a*b*x/9)",
                            "minimum(a*x, b)",
                            "maximum(a*x, b)",
                            "where(x <= 1, a*x, b*x)",
                            "-a*b"};
  const std::vector<double> x{0.3, 0.7, 1.4, 2.1};
  const std::vector<const double*> columns{x.data()};
  for (const char* text : formulas) {
    const expr::Program program(parse_expr(text), {"x"}, {"a", "b"});
    const BoundProgram bound(program, x.size(), columns);
    const std::vector<double> p{0.8, 1.3};
    bound.sweep(p, true, [&](const BoundProgram::Block& block) {
      for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t i = 0; i < block.count; ++i) {
          auto high = p, low = p;
          high[s] += 1e-6;
          low[s] -= 1e-6;
          const std::vector<double> row{x[i]};
          EXPECT_NEAR(block.derivative[s][i], (program(row, high) - program(row, low)) / 2e-6, 1e-8)
              << text << " by " << s << " at " << x[i];
        }
    });
  }
}

} // namespace
} // namespace frictab::expr_test
