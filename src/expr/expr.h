// Formulas as data. A friction law is written once as an Expr, which yields its value, its
// derivatives (parameters and state), its text in Python's spelling, its bounds (bounds.h,
// taylor_model.h) and the statements of generated code (codegen/statements.h).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace frictab::expr {

enum class Op {
  constant,
  symbol,
  negate,
  add,
  subtract,
  multiply,
  divide,
  power,
  exp,
  log,
  sqrt,
  sin,
  tanh,
  acos,
  minimum, // NaN if either operand is NaN
  maximum,
  where_le // operands a, b, x, y: x where a <= b, else y
};

// An immutable formula over named symbols. Cheap to copy; shared subformulas are stored once.
class Expr {
public:
  struct Node;

  Expr(double value = 0.0); // NOLINT: numbers mix freely with formulas
  static Expr symbol(std::string name);
  static Expr make(Op op, std::initializer_list<Expr> operands);

  Op op() const;
  double value() const;            // of a constant
  const std::string& name() const; // of a symbol
  const std::vector<Expr>& operands() const;
  std::size_t depth() const; // nesting depth of operations; 0 for numbers and symbols
  const Node* id() const { return node_.get(); } // equal for shared subformulas

  bool is_constant(double value) const;

private:
  explicit Expr(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
  std::shared_ptr<const Node> node_;
};

Expr operator-(const Expr& a);
Expr operator+(const Expr& a, const Expr& b);
Expr operator-(const Expr& a, const Expr& b);
Expr operator*(const Expr& a, const Expr& b);
Expr operator/(const Expr& a, const Expr& b);
Expr pow(const Expr& a, const Expr& b);
Expr exp(const Expr& a);
Expr log(const Expr& a);
Expr sqrt(const Expr& a);
Expr sin(const Expr& a);
Expr tanh(const Expr& a);
Expr acos(const Expr& a);
Expr minimum(const Expr& a, const Expr& b);
Expr maximum(const Expr& a, const Expr& b);
Expr where_le(const Expr& a, const Expr& b, const Expr& x, const Expr& y);

// Calls `use` once for each subformula, the formula itself first.
void for_each_part(const Expr& formula, const std::function<void(const Expr&)>& use);

// Calls `use` once for each subformula, operands first, from left to right. Walks over formulas are
// built on it, because recursion over operands would overflow the stack on a deep formula.
void inside_out(const Expr& formula, const std::function<void(const Expr&)>& use);

// Names of all symbols in the formula, sorted.
std::set<std::string> symbols(const Expr& formula);

// The formula with some symbols replaced.
Expr substitute(const Expr& formula, const std::map<std::string, Expr>& replacements);

// The formula with some of its nodes (compared by id) replaced.
Expr substitute(const Expr& formula, const std::vector<std::pair<Expr, Expr>>& nodes);

// Applies an operation through the operators, which simplify the result again.
Expr rebuild(Op op, const std::vector<Expr>& operands);

// The same formula, or formulas, with equal subformulas stored once.
Expr shared(const Expr& formula);
std::vector<Expr> shared(const std::vector<Expr>& formulas);

// Text in Python/numpy spelling (minimum, maximum, where, exp, log, sqrt, sin, tanh, arccos, **);
// parse_expr reads it back to a formula with the same bits. Constants round-trip.
std::string to_text(const Expr& formula);

// Size limits of a formula read from text: ten times what frictab itself writes, and far below a
// stack overflow (these limits need 1 MB of stack).
struct FormulaLimits {
  static constexpr std::size_t text = std::size_t{1} << 20; // bytes
  static constexpr std::size_t terms = 200000;              // numbers, names and operations
  static constexpr std::size_t depth = 1000;                // Expr::depth: a + b + c is 2
  static constexpr std::size_t name = 255;                  // bytes
};

// Parses the output of to_text and anything a person would write in that grammar. Throws InputError
// with the column of the fault, also if the formula exceeds FormulaLimits; `file` is used only in
// its message.
Expr parse_expr(std::string_view text, std::string_view file = "formula");
// True if a text is a valid name in a formula: ASCII letters, digits and _, not starting with a
// digit.
bool is_name(std::string_view text);
// True for the name of a function that parse_expr knows.
bool is_function(std::string_view name);
// Length in bytes of the letter or _ at the front; 0 for a digit, a sign, a blank. Names in
// formulas that are parsed may have UTF-8 letters beyond ASCII (ü, µ, Δ): all characters but the
// signs of Latin-1 (°, ², ×) and the blocks of punctuation and mathematical signs.
std::size_t letter_length(std::string_view text);

} // namespace frictab::expr
