// Writes formulas in Python's spelling.
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "expr/expr.h"

namespace frictab::expr {

namespace {

const char* function_name(Op op) {
  switch (op) {
  case Op::exp:
    return "exp";
  case Op::log:
    return "log";
  case Op::sqrt:
    return "sqrt";
  case Op::sin:
    return "sin";
  case Op::tanh:
    return "tanh";
  case Op::acos:
    return "arccos";
  case Op::minimum:
    return "minimum";
  case Op::maximum:
    return "maximum";
  default:
    throw std::logic_error("not a function");
  }
}

// Binding strength in Python: + - (1), * / (2), unary minus (3), ** (4), atoms (5).
int strength(const Expr& e) {
  switch (e.op()) {
  case Op::add:
  case Op::subtract:
    return 1;
  case Op::multiply:
  case Op::divide:
    return 2;
  case Op::negate:
    return 3;
  case Op::power:
    return 4;
  case Op::constant:
    return std::signbit(e.value()) ? 3 : 5;
  default:
    return 5;
  }
}

std::string number(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a formula holds a number that is not finite");
  return fmt::format("{}", value);
}

void write(std::string& text, const Expr& e, int least);

// Writes two operands with a sign between them; `left` and `right` are the binding strengths they
// need.
void write_pair(std::string& text, const Expr& e, const char* sign, int left, int right) {
  write(text, e.operands()[0], left);
  text += sign;
  write(text, e.operands()[1], right);
}

void write_call(std::string& text, const Expr& e) {
  const bool where = e.op() == Op::where_le;
  text += where ? "where" : function_name(e.op());
  for (std::size_t i = 0; i < e.operands().size(); ++i) {
    text += i == 0 ? "(" : where && i == 1 ? " <= " : ", ";
    write(text, e.operands()[i], 1);
  }
  text += ")";
}

void write_bare(std::string& text, const Expr& e) {
  switch (e.op()) {
  case Op::constant:
    text += number(e.value());
    break;
  case Op::symbol:
    text += e.name();
    break;
  case Op::negate:
    text += "-";
    write(text, e.operands()[0], 3);
    break;
  case Op::add:
    write_pair(text, e, " + ", 1, 2);
    break;
  case Op::subtract:
    write_pair(text, e, " - ", 1, 2);
    break;
  case Op::multiply:
    write_pair(text, e, "*", 2, 3);
    break;
  case Op::divide:
    write_pair(text, e, "/", 2, 3);
    break;
  case Op::power:
    write_pair(text, e, "**", 5, 4);
    break;
  default:
    write_call(text, e);
  }
}

void write(std::string& text, const Expr& e, int least) {
  const bool brackets = strength(e) < least;
  if (brackets) text += "(";
  write_bare(text, e);
  if (brackets) text += ")";
}

} // namespace

std::string to_text(const Expr& formula) {
  std::string text;
  write(text, formula, 1);
  return text;
}

} // namespace frictab::expr
