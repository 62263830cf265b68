// Writes formulas in Python's spelling.
#include <cmath>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "expr/expr.h"

namespace frictab::expr {

namespace {

const char* function_name(Op op) {
  static const std::map<Op, const char*> names = {
      {Op::exp, "exp"},         {Op::log, "log"},         {Op::sqrt, "sqrt"},
      {Op::sin, "sin"},         {Op::tanh, "tanh"},       {Op::acos, "arccos"},
      {Op::minimum, "minimum"}, {Op::maximum, "maximum"}, {Op::where_le, "where"}};
  return names.at(op);
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

void write_call(std::string& text, const Expr& e) {
  const bool where = e.op() == Op::where_le;
  text += function_name(e.op());
  for (std::size_t i = 0; i < e.operands().size(); ++i) {
    text += i == 0 ? "(" : where && i == 1 ? " <= " : ", ";
    write(text, e.operands()[i], 1);
  }
  text += ")";
}

void write_bare(std::string& text, const Expr& e) {
  struct Sign { // between two operands, and the binding strengths that these need
    const char* text;
    int left, right;
  };
  static const std::map<Op, Sign> signs = {{Op::add, {" + ", 1, 2}},
                                           {Op::subtract, {" - ", 1, 2}},
                                           {Op::multiply, {"*", 2, 3}},
                                           {Op::divide, {"/", 2, 3}},
                                           {Op::power, {"**", 5, 4}}};
  if (e.op() == Op::constant) {
    text += number(e.value());
  } else if (e.op() == Op::symbol) {
    text += e.name();
  } else if (e.op() == Op::negate) {
    text += "-";
    write(text, e.operands()[0], 3);
  } else if (const auto sign = signs.find(e.op()); sign != signs.end()) {
    write(text, e.operands()[0], sign->second.left);
    text += sign->second.text;
    write(text, e.operands()[1], sign->second.right);
  } else {
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
