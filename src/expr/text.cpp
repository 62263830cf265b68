// Formulas to text in Python's spelling.
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

std::string text_at(const Expr& e, int least) {
  const auto& a = e.operands();
  std::string text;
  switch (e.op()) {
  case Op::constant:
    text = number(e.value());
    break;
  case Op::symbol:
    text = e.name();
    break;
  case Op::negate:
    text = "-" + text_at(a[0], 3);
    break;
  case Op::add:
    text = text_at(a[0], 1) + " + " + text_at(a[1], 2);
    break;
  case Op::subtract:
    text = text_at(a[0], 1) + " - " + text_at(a[1], 2);
    break;
  case Op::multiply:
    text = text_at(a[0], 2) + "*" + text_at(a[1], 3);
    break;
  case Op::divide:
    text = text_at(a[0], 2) + "/" + text_at(a[1], 3);
    break;
  case Op::power:
    text = text_at(a[0], 5) + "**" + text_at(a[1], 4);
    break;
  case Op::where_le:
    text = "where(" + text_at(a[0], 1) + " <= " + text_at(a[1], 1) + ", " + text_at(a[2], 1) +
           ", " + text_at(a[3], 1) + ")";
    break;
  default:
    text = std::string(function_name(e.op())) + "(" + text_at(a[0], 1);
    for (std::size_t i = 1; i < a.size(); ++i)
      text += ", " + text_at(a[i], 1);
    text += ")";
  }
  return strength(e) < least ? "(" + text + ")" : text;
}

} // namespace

std::string to_text(const Expr& formula) {
  return text_at(formula, 1);
}

} // namespace frictab::expr
