// Formula nodes, with the simplifications that keep generated code short (x*1, x+0, constants).
#include "expr/expr.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "expr/arithmetic.h"

namespace frictab::expr {

struct Expr::Node {
  Node(Op of, double number, std::string named, std::vector<Expr> on);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  Op op;
  double value;
  std::string name;
  std::vector<Expr> operands;
  std::size_t depth = 0;
};

Expr::Node::Node(Op of, double number, std::string named, std::vector<Expr> on)
    : op(of), value(number), name(std::move(named)), operands(std::move(on)) {
  for (const Expr& operand : operands)
    depth = std::max(depth, operand.depth() + 1);
}

// Destroys the nodes of a deep formula in a loop, because recursion would overflow the stack.
Expr::Node::~Node() {
  if (operands.empty()) return;
  static thread_local std::vector<Expr>* waiting = nullptr;
  if (waiting) {
    for (Expr& operand : operands)
      waiting->push_back(std::move(operand));
    return;
  }
  std::vector<Expr> left = std::move(operands);
  waiting = &left;
  while (!left.empty()) {
    const Expr next = std::move(left.back());
    left.pop_back();
  }
  waiting = nullptr;
}

Expr::Expr(double value)
    : node_(std::make_shared<Node>(Op::constant, value, "", std::vector<Expr>())) {}

Expr Expr::symbol(std::string name) {
  return Expr(std::make_shared<Node>(Op::symbol, 0, std::move(name), std::vector<Expr>()));
}

Expr Expr::make(Op op, std::initializer_list<Expr> operands) {
  std::vector<Expr> list(operands);
  double values[4] = {};
  bool all_constant = true;
  for (std::size_t i = 0; i < list.size(); ++i) {
    all_constant = all_constant && list[i].op() == Op::constant;
    if (all_constant) values[i] = list[i].value();
  }
  if (all_constant) return Expr(apply(op, values[0], values[1], values[2], values[3]));
  return Expr(std::make_shared<Node>(op, 0, "", std::move(list)));
}

Op Expr::op() const {
  return node_->op;
}
double Expr::value() const {
  return node_->value;
}
const std::string& Expr::name() const {
  return node_->name;
}
const std::vector<Expr>& Expr::operands() const {
  return node_->operands;
}
std::size_t Expr::depth() const {
  return node_->depth;
}
bool Expr::is_constant(double value) const {
  return op() == Op::constant && node_->value == value;
}

Expr operator-(const Expr& a) {
  return Expr::make(Op::negate, {a});
}

Expr operator+(const Expr& a, const Expr& b) {
  if (a.is_constant(0)) return b;
  if (b.is_constant(0)) return a;
  return Expr::make(Op::add, {a, b});
}

Expr operator-(const Expr& a, const Expr& b) {
  if (b.is_constant(0)) return a;
  return Expr::make(Op::subtract, {a, b});
}

Expr operator*(const Expr& a, const Expr& b) {
  if (a.is_constant(1)) return b;
  if (b.is_constant(1)) return a;
  return Expr::make(Op::multiply, {a, b});
}

Expr operator/(const Expr& a, const Expr& b) {
  if (b.is_constant(1)) return a;
  return Expr::make(Op::divide, {a, b});
}

Expr pow(const Expr& a, const Expr& b) {
  return Expr::make(Op::power, {a, b});
}
Expr exp(const Expr& a) {
  return Expr::make(Op::exp, {a});
}
Expr log(const Expr& a) {
  return Expr::make(Op::log, {a});
}
Expr sqrt(const Expr& a) {
  return Expr::make(Op::sqrt, {a});
}
Expr sin(const Expr& a) {
  return Expr::make(Op::sin, {a});
}
Expr tanh(const Expr& a) {
  return Expr::make(Op::tanh, {a});
}
Expr acos(const Expr& a) {
  return Expr::make(Op::acos, {a});
}
Expr minimum(const Expr& a, const Expr& b) {
  return Expr::make(Op::minimum, {a, b});
}
Expr maximum(const Expr& a, const Expr& b) {
  return Expr::make(Op::maximum, {a, b});
}

Expr where_le(const Expr& a, const Expr& b, const Expr& x, const Expr& y) {
  return Expr::make(Op::where_le, {a, b, x, y});
}

Expr rebuild(Op op, const std::vector<Expr>& a) {
  switch (op) {
  case Op::add:
    return a[0] + a[1];
  case Op::subtract:
    return a[0] - a[1];
  case Op::multiply:
    return a[0] * a[1];
  case Op::divide:
    return a[0] / a[1];
  default:
    break;
  }
  if (a.size() == 1) return Expr::make(op, {a[0]});
  if (a.size() == 2) return Expr::make(op, {a[0], a[1]});
  return Expr::make(op, {a[0], a[1], a[2], a[3]});
}

void for_each_part(const Expr& formula, const std::function<void(const Expr&)>& use) {
  std::unordered_set<const Expr::Node*> seen;
  std::vector<const Expr*> open{&formula};
  while (!open.empty()) {
    const Expr& e = *open.back();
    open.pop_back();
    if (!seen.insert(e.id()).second) continue;
    use(e);
    for (std::size_t i = e.operands().size(); i-- > 0;)
      open.push_back(&e.operands()[i]);
  }
}

void inside_out(const Expr& formula, const std::function<void(const Expr&)>& use) {
  struct Open {
    const Expr* e;
    std::size_t next; // index of the next operand to visit
  };
  std::unordered_set<const Expr::Node*> seen;
  std::vector<Open> open{{&formula, 0}};
  while (!open.empty()) {
    const Expr& e = *open.back().e;
    const std::size_t next = open.back().next++;
    if (next == 0 && !seen.insert(e.id()).second) {
      open.pop_back();
    } else if (next < e.operands().size()) {
      open.push_back({&e.operands()[next], 0});
    } else {
      use(e);
      open.pop_back();
    }
  }
}

namespace {

using Replaced = std::unordered_map<const Expr::Node*, Expr>;

// The operands of `e` after replacement.
std::vector<Expr> replaced_operands(const Expr& e, const Replaced& done) {
  std::vector<Expr> operands;
  for (const Expr& operand : e.operands())
    operands.push_back(done.at(operand.id()));
  return operands;
}

Expr replace(const Expr& formula, const std::map<std::string, Expr>& with, Replaced& done) {
  inside_out(formula, [&](const Expr& e) {
    if (done.count(e.id())) return;
    Expr result = e;
    if (e.op() == Op::symbol) {
      if (const auto found = with.find(e.name()); found != with.end()) result = found->second;
    } else if (!e.operands().empty()) {
      result = rebuild(e.op(), replaced_operands(e, done));
    }
    done.emplace(e.id(), result);
  });
  return done.at(formula.id());
}

} // namespace

std::set<std::string> symbols(const Expr& formula) {
  std::set<std::string> names;
  for_each_part(formula, [&](const Expr& part) {
    if (part.op() == Op::symbol) names.insert(part.name());
  });
  return names;
}

namespace {

// Identifies equal nodes once their operands are shared.
using NodeKey = std::tuple<Op, std::uint64_t, std::string, std::vector<const Expr::Node*>>;

Expr share_node(const Expr& e, const std::vector<Expr>& operands, std::map<NodeKey, Expr>& known) {
  NodeKey key{e.op(), 0, "", {}};
  if (e.op() == Op::constant) std::get<1>(key) = std::bit_cast<std::uint64_t>(e.value());
  if (e.op() == Op::symbol) std::get<2>(key) = e.name();
  for (const Expr& operand : operands)
    std::get<3>(key).push_back(operand.id());
  if (const auto found = known.find(key); found != known.end()) return found->second;
  const Expr result = operands.empty() ? e : rebuild(e.op(), operands);
  known.emplace(std::move(key), result);
  return result;
}

Expr share(const Expr& formula, std::map<NodeKey, Expr>& known, Replaced& done) {
  inside_out(formula, [&](const Expr& e) {
    if (!done.count(e.id())) done.emplace(e.id(), share_node(e, replaced_operands(e, done), known));
  });
  return done.at(formula.id());
}

} // namespace

Expr shared(const Expr& formula) {
  std::map<NodeKey, Expr> known;
  Replaced done;
  return share(formula, known, done);
}

std::vector<Expr> shared(const std::vector<Expr>& formulas) {
  std::map<NodeKey, Expr> known;
  Replaced done;
  std::vector<Expr> out;
  for (const Expr& formula : formulas)
    out.push_back(share(formula, known, done));
  return out;
}

Expr substitute(const Expr& formula, const std::map<std::string, Expr>& replacements) {
  Replaced done;
  return replace(formula, replacements, done);
}

Expr substitute(const Expr& formula, const std::vector<std::pair<Expr, Expr>>& nodes) {
  Replaced done;
  for (const auto& [node, by] : nodes)
    done.emplace(node.id(), by);
  return replace(formula, {}, done);
}

} // namespace frictab::expr
