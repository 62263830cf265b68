// Derivatives as formulas: against Program's reverse sweep and against differences.
#include <cmath>

#include <gtest/gtest.h>

#include "expr/derivative.h"
#include "expr/program.h"
#include "support/generated.h"
#include "support/sample_data.h"
#include "table/drift.h"

namespace frictab::derivative_test {

using expr::Expr;
using expr::Program;

namespace {

double value_at(const Expr& formula, double x, double y) {
  const Program program(formula, {"x", "y"}, {});
  const double row[] = {x, y};
  return program(row, {});
}

double swept_at(const Expr& formula, double x, double y, std::size_t by) {
  const Program program(formula, {"x", "y"}, {});
  const double row[] = {x, y};
  double slopes[2];
  program.gradient(row, {}, slopes);
  return slopes[by];
}

const char* const formulas[] = {"-x + y",
                                "x - 2*y",
                                "x*y*x",
                                "x/y - 3/x",
                                "x**2.5 + x**2 + x**1",
                                "x**y + 2**x",
                                "exp(-x*y)",
                                "log(x + y)",
                                "sqrt(x*x + y)",
                                "sin(x*y)",
                                "tanh(x - y)",
                                "arccos(0.3*x/y)",
                                "minimum(x*x, y)",
                                "maximum(x*x, y)",
                                "where(x <= y, x*y, x/y)"};

TEST(Derivative, OfEveryOperationIsThatOfTheSweepAndOfDifferences) {
  for (const char* text : formulas) {
    const Expr formula = expr::parse_expr(text);
    for (const auto& [x, y] : {std::pair{0.7, 1.3}, {1.9, 1.1}, {2.2, 0.9}}) {
      const double h = 1e-5;
      const double by[] = {(value_at(formula, x + h, y) - value_at(formula, x - h, y)) / (2 * h),
                           (value_at(formula, x, y + h) - value_at(formula, x, y - h)) / (2 * h)};
      for (std::size_t i = 0; i < 2; ++i) {
        const double d = value_at(derivative(formula, i == 0 ? "x" : "y"), x, y);
        const double swept = swept_at(formula, x, y, i);
        EXPECT_NEAR(d, swept, 1e-14 * (1 + std::abs(swept))) << text;
        EXPECT_NEAR(d, by[i], 1e-8 * (1 + std::abs(by[i]))) << text; // h^2 and 1e-16/h
      }
    }
  }
}

TEST(Derivative, AtAKinkIsTheSideThatTheSweepTakes) {
  for (const char* text : {"minimum(2*x, x + 1)", "maximum(2*x, x + 1)", "minimum(x + 1, 2*x)",
                           "where(x <= 1, 3*x, x + 2)", "where(1 <= x, 3*x, x + 2)"}) {
    const Expr formula = expr::parse_expr(text);
    EXPECT_EQ(value_at(derivative(formula, "x"), 1, 0), swept_at(formula, 1, 0, 0)) << text;
  }
}

TEST(Derivative, IsFreeOfWhatABranchNotTakenHolds) {
  const test::FloatTraps traps;
  const Expr x = Expr::symbol("x");
  EXPECT_EQ(value_at(derivative(where_le(x, 0.0, 2.0 * x, sqrt(x)), "x"), 0, 0), 2);
  EXPECT_EQ(value_at(derivative(minimum(x, pow(x, 0.5)), "x"), 0, 0), 1);
  EXPECT_EQ(value_at(derivative(pow(x, 1.5), "x"), 0, 0), 0);
  EXPECT_EQ(value_at(derivative(pow(x, Expr::symbol("y")), "y"), 0, 3), 0);
  EXPECT_EQ(value_at(derivative(pow(x, 3.0), "x"), -2, 0), 12);
  EXPECT_TRUE(std::isfinite(value_at(derivative(sqrt(x), "x"), 0, 0)));
  EXPECT_TRUE(std::isfinite(value_at(derivative(acos(x), "x"), 1, 0)));
}

TEST(Derivative, OfWhatDoesNotDependOnTheSymbolIsTheConstantZero) {
  const Expr formula = expr::parse_expr("minimum(y, 3)*exp(y)/sqrt(y) - y**y");
  EXPECT_TRUE(derivative(formula, "x").is_constant(0));
}

// The two of every law: its piece and what makes tau_R of it, under the shear limit.
TEST(Derivative, OfEveryLawIsThatOfTheSweep) {
  for (const models::Law& law : models::all_laws()) {
    const models::AssembledLaw assembled(test::plausible_model(law));
    const Expr& tau = assembled.tau_R;
    const std::vector<std::string>& states = assembled.inputs;
    const Program program(tau, states, assembled.parameters);
    std::vector<Program> slopes;
    for (const Expr& slope : derivatives(tau, states))
      slopes.emplace_back(slope, states, assembled.parameters);
    const auto columns = test::random_states(states, 300, 5);
    for (std::size_t i = 0; i < 300; ++i) {
      std::vector<double> row, swept(states.size());
      for (const auto& column : columns)
        row.push_back(column[i]);
      const double value = program.gradient(row, assembled.model.parameters, swept);
      for (std::size_t s = 0; s < states.size(); ++s)
        EXPECT_NEAR(slopes[s](row, assembled.model.parameters), swept[s],
                    1e-13 * (std::abs(swept[s]) + std::abs(value / row[s])))
            << law.name << " by " << states[s];
    }
  }
}

} // namespace
} // namespace frictab::derivative_test
