// Formulas: what is taken prints as a text that gives the same bits, its enclosures hold its
// values, and everything that walks a formula comes to an end.
#include <bit>
#include <cmath>
#include <cstdint>

#include "codegen/statements.h"
#include "expr/coordinates.h"
#include "expr/derivative.h"
#include "expr/expr.h"
#include "expr/program.h"
#include "expr/sensitivity.h"
#include "fuzz/target.h"

namespace frictab::fuzz::formula_target {
namespace {

using expr::Expr;
using expr::shared;

std::vector<std::string> names_of(const Expr& formula) {
  const auto names = expr::symbols(formula);
  return {names.begin(), names.end()};
}

// The row of symbols' values that is number `row`: small, large, negative ones.
std::vector<double> values(std::size_t count, std::size_t row) {
  std::vector<double> out(count);
  for (std::size_t i = 0; i < count; ++i)
    out[i] =
        row == 0 ? 1.0 + static_cast<double>(i) : (row == 1 ? -0.375 : 1e3) / (1.0 + double(i));
  return out;
}

bool same_bits(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

void check_reads_back(const Expr& formula, const std::vector<std::string>& names) {
  const std::string text = expr::to_text(formula);
  if (text.size() > expr::FormulaLimits::text) return;
  const Expr again = expr::parse_expr(text);
  promise(expr::to_text(again) == text, "a formula read back prints the same text");
  const expr::Program first(formula, names, {}), second(again, names, {});
  for (std::size_t row = 0; row < 3; ++row) {
    const auto at = values(names.size(), row);
    promise(same_bits(first(at, {}), second(at, {})), "a formula read back gives the same bits");
  }
}

void check_enclosed(const Expr& formula, const std::vector<std::string>& names) {
  if (names.empty()) return;
  const expr::Program program(formula, names, {});
  const expr::Sensitivity sensitivity(formula, names, names.front());
  for (std::size_t row = 0; row < 3; ++row) {
    const auto at = values(names.size(), row);
    std::vector<expr::Bounds> box;
    for (const double x : at)
      box.push_back(expr::outward(std::min(x, 1.25 * x), std::max(x, 1.25 * x)));
    const expr::Bounds range = sensitivity(box).range;
    const double value = program(at, {});
    promise(!std::isfinite(value) || (range.low <= value && value <= range.high),
            "a formula's value lies in its range");
  }
}

void write_statements(const Expr& formula) {
  for (const auto language : {codegen::Language::c, codegen::Language::fortran}) {
    codegen::Spelling spelling;
    spelling.language = language;
    codegen::Names names;
    codegen::to_statements({{shared(formula), "tau"}}, spelling, names);
  }
}

void read(std::string_view text) {
  const Expr formula = expr::parse_expr(text);
  const auto names = names_of(formula);
  check_reads_back(formula, names);
  check_enclosed(formula, names);
  expr::in_coordinates(formula, {names.begin(), names.end()});
  write_statements(formula);
  if (!names.empty()) write_statements(expr::derivative(formula, names.front()));
}

const Registered<Target> registered([] { return Target{"formula", read}; });

} // namespace
} // namespace frictab::fuzz::formula_target
