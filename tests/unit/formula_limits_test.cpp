// Formulas from files that a stranger wrote: too large ones are refused, and none ends the stack.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/calibration_file.h"
#include "codegen/statements.h"
#include "core/error.h"
#include "expr/bounds.h"
#include "expr/derivative.h"
#include "expr/expr.h"
#include "expr/program.h"
#include "io/hdf5.h"
#include "support/refusal.h"
#include "support/run_command.h"
#include "support/sample_data.h"
#include "support/traced_law.h"
#include "table/table_file.h"

namespace frictab::formula_limits_test {
namespace {

using expr::Expr;
using expr::FormulaLimits;
using testing::HasSubstr;

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  for (std::size_t i = 0; i < times; ++i)
    out += text;
  return out;
}

// Each is of 20 000 parts, and each ended the stack somewhere or would have.
const std::vector<std::pair<std::string, std::string>>& huge() {
  constexpr std::size_t n = 20000;
  static const std::vector<std::pair<std::string, std::string>> all = {
      {"terms", "value" + repeated(" + value", n)},
      {"factors", "value" + repeated("*value", n)},
      {"brackets", repeated("(", n) + "value" + repeated(")", n)},
      {"signs", repeated("-", n) + "value"},
      {"calls", repeated("exp(", n) + "value" + repeated(")", n)},
      {"powers", "value" + repeated("**value", n)},
      {"a name", repeated("v", n)}};
  return all;
}

void expect_refused(const test::CommandResult& result, const std::string& what) {
  EXPECT_EQ(result.exit_code, 2) << what << result.err.substr(0, 500);
  EXPECT_THAT(result.err, HasSubstr("in the formula")) << what;
  EXPECT_LT(result.err.size(), 2000u) << what;
}

// A file with a formula of its own in place of the constant `value*sigma_n_MPa`.
void write_table_with(const std::string& formula, const std::string& file) {
  const double value = 0.1;
  io::Hdf5Writer out(file);
  out.dataset("value", {}, {&value, 1});
  for (const auto& [name, text] : std::map<std::string, std::string>{{"quantity", "mu"},
                                                                     {"units", "1"},
                                                                     {"transform", "linear"},
                                                                     {"interpolation", "linear"},
                                                                     {"combine", "value"}})
    out.attribute("value", name, text);
  for (std::size_t part = 0; part * 60000 < formula.size(); ++part)
    out.attribute("value", part == 0 ? "extension" : fmt::format("extension_{}", part + 1),
                  formula.substr(part * 60000, 60000));
  out.attribute("/", "schema", std::string("frictab/table/2"));
  out.close();
}

TEST(FormulaLimits, AHugeFormulaInATableFileIsRefused) {
  const test::TemporaryDirectory directory;
  for (const auto& [what, formula] : huge()) {
    write_table_with(formula, directory.path("t.h5"));
    expect_refused(test::run_frictab({"table", "info", "t.h5"}, directory.path()), what);
    expect_refused(test::run_frictab({"export", "--table", "t.h5", "--targets", "c", "-o", "out"},
                                     directory.path()),
                   what);
  }
}

TEST(FormulaLimits, AHugeFormulaInAJobIsRefused) {
  const test::TemporaryDirectory directory;
  directory.write("a.csv", "sigma_n_MPa,value\n1000,80\n");
  for (const auto& [what, formula] : huge()) {
    directory.write("job.toml", "[data]\ntraining = \"a.csv\"\n[data.columns]\n"
                                "tau_R_MPa = { formula = \"" +
                                    formula + "\" }\n");
    expect_refused(test::run_frictab({"data", "job.toml"}, directory.path()), what);
  }
}

TEST(FormulaLimits, AHugeFormulaInAModelFileIsRefused) {
  calibrate::ModelFit fit;
  fit.model = test::network_model(1, 1);
  fit.std_error.assign(fit.model.parameters.size(), 0);
  const std::string good = calibrate::model_json(fit, {});
  ASSERT_NO_THROW(calibrate::parse_model(good, "model.json"));
  const std::string key = "\"combine\": \"";
  const std::size_t first = good.find(key) + key.size();
  for (const auto& [what, formula] : huge()) {
    std::string bad = good;
    bad.replace(first, bad.find('"', first) - first, formula);
    EXPECT_THROW(calibrate::parse_model(bad, "model.json"), InputError) << what;
  }
}

TEST(FormulaLimits, AMessageNamesPlaceAndLimitAndIsShort) {
  try {
    expr::parse_expr("a" + repeated("+a", 20000), "t.h5");
    FAIL();
  } catch (const InputError& error) {
    const Fault& fault = error.faults().front();
    EXPECT_EQ(fault.place.file, "t.h5");
    EXPECT_EQ(fault.place.column, 2 * (FormulaLimits::depth + 1) + 2);
    EXPECT_THAT(fault.hint, HasSubstr(fmt::format("at most {}", FormulaLimits::depth)));
    EXPECT_LT(fault.what.size(), 400u);
  }
}

TEST(FormulaLimits, TextAndTermsAreLimitedToo) {
  EXPECT_THROW(expr::parse_expr(std::string(FormulaLimits::text, ' ') + "a"), InputError);
  std::string wide = "a"; // deep as its logarithm
  for (int i = 0; i < 17; ++i)
    wide = "(" + wide + "+" + wide + ")";
  EXPECT_THROW(expr::parse_expr(wide), InputError);
}

// As deep as is taken, and four times that: what is derived from it is deeper.
TEST(FormulaLimits, AFormulaAtTheLimitIsWorkedOnWithoutEndingTheStack) {
  for (const char* link : {" + a", "*a", " - sin(a)", "/b"}) {
    const Expr deep = expr::parse_expr("a" + repeated(link, FormulaLimits::depth - 1));
    const Expr slope = shared(derivative(derivative(deep, "a"), "b"));
    const Expr copy = substitute(slope, {{"a", Expr::symbol("c")}});
    EXPECT_EQ(expr::symbols(copy).count("a"), 0u);
    EXPECT_FALSE(expr::to_text(deep).empty());
    EXPECT_GT(expr::Program(deep, {"a", "b"}, {})(std::vector<double>{1.5, 1.5}, {}), -1e300);
  }
}

TEST(FormulaLimits, ADerivativeThatIsInfiniteIsAFaultOfTheFormula) {
  for (const char* text : {"1e308*a*10", "a*1e200*1e200"}) {
    const Expr slope = derivative(expr::parse_expr(text), "a");
    codegen::Names names;
    EXPECT_THROW(codegen::to_statements({{slope, "slope"}}, {}, names), InputError) << text;
  }
}

TEST(FormulaLimits, ADivisionByZeroIsRefusedAtItsPlace) {
  for (const char* text : {"value/0", "value*k_MPa/(1-1)", "1/0"})
    EXPECT_THAT(test::refusal([&] { expr::parse_expr(text, "law.toml"); }),
                testing::HasSubstr("law.toml:1:"))
        << text;
}

TEST(FormulaLimits, TheEndOfAVeryDeepFormulaDoesNotEndTheStack) {
  Expr deep = Expr::symbol("a");
  for (int i = 0; i < 1000000; ++i)
    deep = exp(deep);
  EXPECT_EQ(deep.depth(), 1000000u);
}

void expect_far_below(const models::Model& model) {
  const models::Formula formula = model.law->build(model.conventions);
  for (const Expr& e : {formula.value, formula.combine, models::tau_formula(*model.law, {})}) {
    const std::string text = expr::to_text(e);
    std::size_t terms = 0; // as often as they are written
    for (std::size_t i = 0; i < text.size(); ++i)
      terms += std::string_view("+-*/(,").find(text[i]) != std::string_view::npos;
    EXPECT_LT(10 * e.depth(), FormulaLimits::depth) << model.law->name;
    EXPECT_LT(10 * 2 * terms, FormulaLimits::terms) << model.law->name;
    EXPECT_LT(5 * text.size(), FormulaLimits::text) << model.law->name;
    EXPECT_NO_THROW(expr::parse_expr(text)) << model.law->name;
  }
}

TEST(FormulaLimits, WhatFrictabWritesStaysBelowATenthOfThem) {
  for (const models::Law& law : Registry<models::Law>::instance().all())
    expect_far_below(test::plausible_model(law));
  expect_far_below(test::network_model(20, 8)); // as many nets as are trained at most
  expect_far_below(test::traced_model({"humidity", "work", "tool", "peak", "curve", "surface",
                                       "curve_by_tool", "heating", "since_peak"}));
}

} // namespace
} // namespace frictab::formula_limits_test
