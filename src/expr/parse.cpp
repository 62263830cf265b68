// Parses formulas in Python spelling: + - * / ** ( ) numbers, names and the functions of expr.h.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "expr/expr.h"

namespace frictab::expr {

namespace {

constexpr int max_depth = 200;    // nested brackets; nobody writes deeper formulas
constexpr std::size_t shown = 60; // bytes shown of a long formula on either side of a fault

bool is_ascii_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Functions composed of other operations, so that languages and bounds need not support them.
Expr magnitude(const Expr& x) {
  return maximum(x, -x);
}
Expr sign(const Expr& x) {
  return where_le(x, 0, where_le(0, x, 0, -1), 1);
}
// As accurate near 0 as elsewhere; the largest error is 1e-8, within 1e-8 of pi/2.
Expr arctangent(const Expr& x) {
  return std::numbers::pi / 2 - acos(x / sqrt(1.0 + x * x));
}

using Function = Expr (*)(const Expr&);
using FunctionOfTwo = Expr (*)(const Expr&, const Expr&);

// Functions by the names that to_text writes, and common alternatives; nullptr for other names.
Function function_of_one(std::string_view name) {
  static const std::map<std::string_view, Function> known = {
      {"exp", exp},         {"log", log},           {"ln", log},        {"sqrt", sqrt},
      {"sin", sin},         {"tanh", tanh},         {"arccos", acos},   {"acos", acos},
      {"atan", arctangent}, {"arctan", arctangent}, {"abs", magnitude}, {"sign", sign}};
  const auto found = known.find(name);
  return found == known.end() ? nullptr : found->second;
}
FunctionOfTwo function_of_two(std::string_view name) {
  if (name == "minimum" || name == "min") return minimum;
  return name == "maximum" || name == "max" ? maximum : nullptr;
}

class Parser {
public:
  Parser(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  Expr parse() {
    if (text_.size() > FormulaLimits::text)
      too_large(fmt::format("{} bytes", text_.size()), FormulaLimits::text);
    Expr e = sum();
    if (at_ < text_.size()) unexpected();
    // finds a division by a constant 0, which is folded immediately
    for_each_part(e, [this](const Expr& part) {
      if (part.op() == Op::constant && !std::isfinite(part.value()))
        fail("a constant term is not a finite number");
    });
    return e;
  }

private:
  [[noreturn]] void fail(const std::string& what, const std::string& hint = "") const {
    throw InputError({std::string(file_), 1, at_ + 1}, what + " in the formula '" + excerpt() + "'",
                     hint);
  }

  [[noreturn]] void unexpected() const {
    const std::string_view left = text_.substr(at_);
    fail(fmt::format("unexpected '{}'",
                     left.substr(0, std::max<std::size_t>(1, utf8_length(left)))));
  }

  [[noreturn]] void too_large(const std::string& what, std::size_t most) const {
    fail(fmt::format("{} are too many", what),
         fmt::format("at most {}; nothing that frictab writes comes near: is this a formula?",
                     most));
  }

  // The formula; for a long one, only the text around the fault.
  std::string excerpt() const {
    if (text_.size() <= 4 * shown) return std::string(text_);
    const std::size_t first = at_ - std::min(at_, shown);
    const std::string part(text_.substr(first, at_ + shown - first));
    return (first > 0 ? "... " : "") + part + (at_ + shown < text_.size() ? " ..." : "");
  }

  // Counts a term and returns the parsed formula; throws if it is too large.
  Expr counted(Expr e) {
    if (++terms_ > FormulaLimits::terms)
      too_large(fmt::format("{} numbers, names and operations", terms_), FormulaLimits::terms);
    if (e.depth() > FormulaLimits::depth)
      too_large(fmt::format("{} operations within each other", e.depth()), FormulaLimits::depth);
    return e;
  }

  void skip() {
    while (at_ < text_.size() && std::string_view(" \t\r\n").find(text_[at_]) != text_.npos)
      ++at_;
  }

  bool accept(std::string_view token) {
    skip();
    if (text_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    skip();
    return true;
  }

  void expect(std::string_view token) {
    if (!accept(token)) fail(fmt::format("expected '{}'", token));
  }

  Expr sum() {
    Expr e = product();
    for (;;) {
      if (accept("+"))
        e = counted(e + product());
      else if (accept("-"))
        e = counted(e - product());
      else
        return e;
    }
  }

  Expr product() {
    Expr e = unary();
    for (;;) {
      if (text_.substr(at_, 2) == "**") fail("unexpected '**'");
      if (accept("*"))
        e = counted(e * unary());
      else if (accept("/"))
        e = counted(e / divisor());
      else
        return e;
    }
  }

  Expr divisor() {
    Expr e = unary();
    if (e.is_constant(0)) fail("division by 0");
    return e;
  }

  Expr unary() {
    if (++depth_ > max_depth) fail("too many nested terms");
    Expr e = accept("-") ? counted(-unary()) : power();
    --depth_;
    return e;
  }

  Expr power() {
    Expr base = atom();
    if (accept("**") || accept("^")) return counted(pow(base, unary()));
    return base;
  }

  Expr atom() {
    skip();
    if (at_ >= text_.size()) fail("the formula ends too early");
    if (accept("(")) {
      Expr e = sum();
      expect(")");
      return e;
    }
    const char c = text_[at_];
    if (is_digit(c) || c == '.') return number();
    if (letter_length(text_.substr(at_)) > 0) return name();
    unexpected();
  }

  Expr number() {
    double value = 0;
    const auto [end, code] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (code != std::errc()) fail("not a number");
    at_ = static_cast<std::size_t>(end - text_.data());
    skip();
    return counted(value);
  }

  Expr name() {
    std::size_t end = at_;
    while (end < text_.size())
      if (const std::size_t letter = letter_length(text_.substr(end)); letter > 0)
        end += letter;
      else if (is_digit(text_[end]))
        ++end;
      else
        break;
    if (end - at_ > FormulaLimits::name)
      fail(fmt::format("a name of {} characters", end - at_),
           fmt::format("at most {}", FormulaLimits::name));
    const std::string name(text_.substr(at_, end - at_));
    at_ = end;
    skip();
    if (at_ < text_.size() && text_[at_] == '(') return call(name);
    return counted(Expr::symbol(name));
  }

  Expr call(const std::string& name) {
    if (!is_function(name)) {
      const std::vector<std::string> known = {"abs",  "arccos", "atan",    "exp",  "ln",
                                              "log",  "max",    "maximum", "min",  "minimum",
                                              "sign", "sin",    "sqrt",    "tanh", "where"};
      fail(fmt::format("unknown function '{}'", name), suggest(name, known));
    }
    expect("(");
    const Expr a = sum();
    if (const Function one = function_of_one(name)) return closed(one(a));
    const FunctionOfTwo two = function_of_two(name);
    expect(two ? "," : "<=");
    const Expr b = sum();
    if (two) return closed(two(a, b));
    expect(",");
    const Expr x = sum();
    expect(",");
    const Expr y = sum();
    return closed(where_le(a, b, x, y));
  }

  Expr closed(Expr e) {
    expect(")");
    return counted(std::move(e));
  }

  std::string_view text_;
  std::string_view file_;
  std::size_t at_ = 0;
  std::size_t terms_ = 0;
  int depth_ = 0;
};

} // namespace

std::size_t letter_length(std::string_view text) {
  if (text.empty()) return 0;
  if (is_ascii_letter(text.front())) return 1;
  const std::size_t length = utf8_length(text);
  if (length < 2) return 0;
  constexpr unsigned lead_bits[] = {0, 0, 0x1F, 0x0F, 0x07};
  unsigned code = static_cast<unsigned char>(text.front()) & lead_bits[length];
  for (const char c : text.substr(1, length - 1))
    code = code << 6u | (static_cast<unsigned char>(c) & 0x3Fu);
  constexpr unsigned micro = 0xB5, first_letter = 0xC0, times = 0xD7, divided = 0xF7;
  const bool is_sign = (code < first_letter && code != micro) || code == times || code == divided ||
                       (code >= 0x2000 && code <= 0x2BFF) || (code >= 0x3000 && code <= 0x303F) ||
                       code >= 0xE000;
  return is_sign ? 0 : length;
}

// Names that are written into routines have letters of ASCII alone.
bool is_name(std::string_view text) {
  return !text.empty() && is_ascii_letter(text.front()) &&
         std::ranges::all_of(text, [](char c) { return is_ascii_letter(c) || is_digit(c); });
}

bool is_function(std::string_view name) {
  return function_of_one(name) || function_of_two(name) || name == "where";
}

Expr parse_expr(std::string_view text, std::string_view file) {
  return shared(Parser(text, file).parse());
}

} // namespace frictab::expr
