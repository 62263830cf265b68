// Formulas to text (Python spelling) and to straight-line C and Fortran.
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "expr/expr.h"
#include "expr/several.h"

namespace frictab::expr {

namespace {

struct Spelling {
  const char* python;
  const char* c;
  const char* fortran;
};

Spelling function_name(Op op) {
  switch (op) {
  case Op::exp:
    return {"exp", "exp", "exp"};
  case Op::log:
    return {"log", "log", "log"};
  case Op::sqrt:
    return {"sqrt", "sqrt", "sqrt"};
  case Op::sin:
    return {"sin", "sin", "sin"};
  case Op::tanh:
    return {"tanh", "tanh", "tanh"};
  case Op::acos:
    return {"arccos", "acos", "acos"};
  case Op::minimum:
    return {"minimum", "ft_min", "ftmin"};
  case Op::maximum:
    return {"maximum", "ft_max", "ftmax"};
  case Op::where_le:
    return {"where", "ft_where_le", "ftwhle"};
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
    text = std::string(function_name(e.op()).python) + "(" + text_at(a[0], 1);
    for (std::size_t i = 1; i < a.size(); ++i)
      text += ", " + text_at(a[i], 1);
    text += ")";
  }
  return strength(e) < least ? "(" + text + ")" : text;
}

std::string literal(double value, Language language) {
  std::string text = fmt::format("{:.17g}", value);
  if (language == Language::c) {
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return std::signbit(value) ? "(" + text + ")" : text;
  }
  const std::size_t e = text.find('e');
  if (e == std::string::npos)
    text += text.find('.') == std::string::npos ? ".0D0" : "D0";
  else {
    std::string mantissa = text.substr(0, e);
    if (mantissa.find('.') == std::string::npos) mantissa += ".0";
    text = mantissa + "D" + text.substr(e + 1);
  }
  return std::signbit(value) ? "(" + text + ")" : text;
}

class Emitter {
public:
  Emitter(Language language, const std::map<std::string, std::string>& rename,
          std::string_view prefix)
      : language_(language), rename_(rename), prefix_(prefix) {}

  std::string emit(const Expr& e) {
    if (e.op() == Op::constant) return literal(e.value(), language_);
    if (e.op() == Op::symbol) {
      const auto found = rename_.find(e.name());
      return found == rename_.end() ? e.name() : found->second;
    }
    if (const auto found = done_.find(e.id()); found != done_.end()) return found->second;
    std::vector<std::string> a;
    for (const Expr& operand : e.operands())
      a.push_back(emit(operand));
    const std::string name = fmt::format("{}{}", prefix_, out.temporaries.size() + 1);
    out.temporaries.push_back(name);
    out.lines.push_back(name + " = " + right_side(e.op(), a));
    done_.emplace(e.id(), name);
    return name;
  }

  Statements out;

private:
  std::string right_side(Op op, const std::vector<std::string>& a) const {
    switch (op) {
    case Op::negate:
      return "-" + a[0];
    case Op::add:
      return a[0] + " + " + a[1];
    case Op::subtract:
      return a[0] + " - " + a[1];
    case Op::multiply:
      return a[0] + "*" + a[1];
    case Op::divide:
      return a[0] + "/" + a[1];
    case Op::power:
      return language_ == Language::c ? "pow(" + a[0] + ", " + a[1] + ")" : a[0] + "**" + a[1];
    default:
      break;
    }
    const Spelling name = function_name(op);
    return fmt::format("{}({})", language_ == Language::c ? name.c : name.fortran,
                       fmt::join(a, ", "));
  }

  Language language_;
  const std::map<std::string, std::string>& rename_;
  std::string prefix_;
  std::map<const Expr::Node*, std::string> done_;
};

} // namespace

std::string to_text(const Expr& formula) {
  return text_at(formula, 1);
}

Statements to_statements(const Expr& formula, Language language,
                         const std::map<std::string, std::string>& rename,
                         std::string_view prefix) {
  Emitter emitter(language, rename, prefix);
  emitter.out.result = emitter.emit(formula);
  return emitter.out;
}

SeveralStatements to_statements(const std::vector<Expr>& formulas, Language language,
                                const std::map<std::string, std::string>& rename,
                                std::string_view prefix) {
  Emitter emitter(language, rename, prefix);
  SeveralStatements out;
  for (const Expr& formula : shared(formulas)) {
    out.results.push_back(emitter.emit(formula));
    out.first_lines.push_back(emitter.out.lines.size());
  }
  out.lines = std::move(emitter.out.lines);
  out.temporaries = std::move(emitter.out.temporaries);
  return out;
}

} // namespace frictab::expr
