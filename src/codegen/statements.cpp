// Writes formulas as statements, operation by operation.
#include "codegen/statements.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include <fmt/format.h>

#include "codegen/number_text.h"
#include "core/error.h"
#include "core/text.h"

namespace frictab::codegen {

using expr::Expr;
using expr::Op;

namespace {

constexpr std::size_t longest_name = 28;
// "tau = ..."; 100 columns then suffice in C, including the declaration.
constexpr std::size_t line_width = 80;
constexpr std::size_t inline_width = 60; // width of a step that is written inside another one

} // namespace

Names::Names(std::set<std::string> taken) : taken_(std::move(taken)) {}

std::string Names::give(const std::string& wish) {
  std::string name;
  for (const char c : wish.substr(0, longest_name))
    name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  // The names in the templates start with ft.
  if (name.empty() || !std::isalpha(static_cast<unsigned char>(name[0])) ||
      lower_case(name).starts_with("ft"))
    name.insert(0, "c_");
  const std::string first = name;
  for (int n = 2; !taken_.insert(lower_case(name)).second; ++n)
    name = fmt::format("{}_{}", first, n);
  return name;
}

namespace {

// Binding strength of a text: inside a stronger operation it needs parentheses.
enum class Strength { negation, sum, product, power, call, atom };

struct Text {
  std::string text;
  Strength strength = Strength::atom;

  std::string at_least(Strength least) const { return strength < least ? "(" + text + ")" : text; }
};

const char* function_name(Op op, Language language) {
  const bool c = language == Language::c;
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
    return "acos";
  case Op::power:
    return "pow";
  case Op::minimum:
    return c ? "ft_min" : "ftmin";
  case Op::maximum:
    return c ? "ft_max" : "ftmax";
  case Op::where_le:
    return c ? "ft_where_le" : "ftwhle";
  default:
    throw std::logic_error("not a function");
  }
}

Text called(Op op, const std::vector<Text>& a, Language language) {
  std::string arguments;
  for (const Text& text : a)
    arguments += (arguments.empty() ? "" : ", ") + text.text;
  return {fmt::format("{}({})", function_name(op, language), arguments), Strength::call};
}

Text joined(const std::vector<Text>& a, const char* sign, Strength left, Strength right,
            Strength whole) {
  return {a[0].at_least(left) + sign + a[1].at_least(right), whole};
}

// Writes an operation; in Fortran with the parentheses that its compilers respect.
Text spelled(Op op, const std::vector<Text>& a, Language language) {
  using enum Strength;
  const bool fortran = language == Language::fortran;
  switch (op) {
  case Op::negate:
    return {"-" + a[0].at_least(call), negation};
  case Op::add:
    return joined(a, " + ", fortran ? product : sum, product, sum);
  case Op::subtract:
    return joined(a, " - ", fortran ? product : sum, product, sum);
  case Op::multiply:
    return joined(a, "*", fortran ? power : product, power, product);
  case Op::divide:
    return joined(a, "/", fortran ? power : product, power, product);
  case Op::power:
    return fortran ? joined(a, "**", call, call, power) : called(op, a, language);
  default:
    return called(op, a, language);
  }
}

// True for operations that are not defined everywhere, or may overflow.
bool is_delicate(Op op) {
  return op == Op::divide || op == Op::power || op == Op::exp || op == Op::log || op == Op::sqrt ||
         op == Op::acos;
}

class StatementWriter {
public:
  StatementWriter(const std::vector<Wanted>& wanted, const Spelling& spelling, Names& names)
      : spelling_(spelling), names_(names) {
    for (const Wanted& one : wanted)
      count(one.formula);
    for (const Wanted& one : wanted) {
      out.results.push_back(result(one));
      out.first_lines.push_back(out.lines.size());
    }
  }

  Statements out;

private:
  void count(const Expr& formula) {
    std::vector<const Expr*> open{&formula};
    while (!open.empty()) {
      const Expr& e = *open.back();
      open.pop_back();
      if (++uses_[e.id()] > 1) continue;
      for (const Expr& operand : e.operands())
        open.push_back(&operand);
    }
  }

  // True if an expression contains only numbers and named constants.
  bool is_fixed(const Expr& e) {
    if (e.op() == Op::constant) return true;
    if (e.op() == Op::symbol) return spelling_.numbers.count(e.name()) > 0;
    const auto known = fixed_.find(e.id());
    if (known != fixed_.end()) return known->second;
    const bool fixed = std::all_of(e.operands().begin(), e.operands().end(),
                                   [this](const Expr& operand) { return is_fixed(operand); });
    return fixed_[e.id()] = fixed;
  }

  Text leaf(const Expr& e) const {
    if (e.op() == Op::symbol) {
      const auto found = spelling_.symbols.find(e.name());
      return {found == spelling_.symbols.end() ? e.name() : found->second};
    }
    const double value = e.value();
    if (!std::isfinite(value)) // from a/0 or 1e308*a*10, by a
      throw InputError({"formula", 0, 0}, "a derivative is a number that is not finite",
                       "look for a division by 0 and for numbers near 1e308");
    const std::string text =
        spelling_.language == Language::c ? c_number(value) : fortran_number(value);
    return {std::signbit(value) ? "(" + text + ")" : text};
  }

  // Assigns to the name `given`, or to the step's own name if that is empty.
  Text assign(const Expr& e, const std::string& text, const std::string& given) {
    const std::string name = given.empty() ? step_name(e) : given;
    out.names.push_back(name);
    out.lines.push_back(spelling_.owner + name + " = " + text);
    return done_.emplace(e.id(), Text{spelling_.owner + name}).first->second;
  }

  std::string step_name(const Expr& e) {
    const auto found = spelling_.steps.find(e.id());
    return names_.give(found != spelling_.steps.end() ? found->second.name
                                                      : fmt::format("t{}", ++unnamed_));
  }

  // Returns the room left on a line after a name.
  std::size_t room_after(std::size_t name) const {
    return line_width - std::min(line_width, spelling_.owner.size() + name + 3);
  }

  bool own_line(const Expr& e) const {
    const auto found = spelling_.steps.find(e.id());
    return uses_.at(e.id()) > 1 || (found != spelling_.steps.end() && found->second.own_line);
  }

  // Writes an expression on its own line.
  Text line(const Expr& e) {
    const auto found = spelling_.steps.find(e.id());
    const std::size_t name = found == spelling_.steps.end() ? 4 : found->second.name.size();
    return assign(e, written(e, room_after(name)).text, "");
  }

  Text operand(const Expr& e, Op of) {
    if (e.operands().empty()) return leaf(e);
    if (const auto found = done_.find(e.id()); found != done_.end()) return found->second;
    // Fortran compilers evaluate expressions without states, and reject undefined results even in a
    // branch that is never taken. They do not if the expression is spread over several statements.
    const bool apart = is_delicate(of) && is_fixed(e);
    return own_line(e) || apart ? line(e) : written(e, inline_width);
  }

  // Writes an expression. If it is too wide, operands get their own lines, the longest first.
  Text written(const Expr& e, std::size_t width) {
    std::vector<Text> a;
    for (const Expr& one : e.operands())
      a.push_back(operand(one, e.op()));
    for (Text text = spelled(e.op(), a, spelling_.language);;
         text = spelled(e.op(), a, spelling_.language)) {
      const auto longest = std::max_element(a.begin(), a.end(), [](const Text& x, const Text& y) {
        return (x.strength == Strength::atom ? 0 : x.text.size()) <
               (y.strength == Strength::atom ? 0 : y.text.size());
      });
      if (text.text.size() <= width || longest->strength == Strength::atom) return text;
      const Expr& part = e.operands()[static_cast<std::size_t>(longest - a.begin())];
      *longest = assign(part, longest->text, "");
    }
  }

  std::string result(const Wanted& wanted) {
    const Expr& e = wanted.formula;
    if (e.operands().empty()) return leaf(e).text;
    if (const auto found = done_.find(e.id()); found != done_.end()) return found->second.text;
    const auto named = spelling_.steps.find(e.id());
    const bool known = named != spelling_.steps.end() && named->second.own_line;
    if (known) return line(e).text;
    return assign(e, written(e, room_after(wanted.name.size())).text, wanted.name).text;
  }

  const Spelling& spelling_;
  Names& names_;
  std::unordered_map<const Expr::Node*, std::size_t> uses_;
  std::unordered_map<const Expr::Node*, bool> fixed_;
  std::unordered_map<const Expr::Node*, Text> done_;
  int unnamed_ = 0;
};

} // namespace

Statements to_statements(const std::vector<Wanted>& wanted, const Spelling& spelling,
                         Names& names) {
  return StatementWriter(wanted, spelling, names).out;
}

} // namespace frictab::codegen
