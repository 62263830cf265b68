// Forward differentiation, node by node. A branch is chosen between derivatives, not between
// adjoints, so that 0 is never multiplied by an infinite slope of the branch not taken.
#include "expr/derivative.h"

#include <numbers>
#include <unordered_map>

namespace frictab::expr {

namespace {

// small, but its reciprocal times an ordinary number does not overflow
constexpr double least_root = 1e-150;

bool is_zero(const Expr& e) {
  return e.is_constant(0);
}

// Products and sums that leave out terms with a zero derivative.
Expr times(const Expr& a, const Expr& b) {
  if (is_zero(a) || is_zero(b)) return 0.0;
  if (a.is_constant(-1)) return -b;
  if (b.is_constant(-1)) return -a;
  return a * b;
}
Expr minus(const Expr& a, const Expr& b) {
  if (!is_zero(a)) return a - b;
  return is_zero(b) ? Expr(0.0) : -b;
}
Expr over(const Expr& a, const Expr& b) {
  return is_zero(a) ? Expr(0.0) : a / b;
}
Expr chosen(const Expr& a, const Expr& b, const Expr& x, const Expr& y) {
  return is_zero(x) && is_zero(y) ? Expr(0.0) : where_le(a, b, x, y);
}

// True if the expression is positive for all values of its symbols.
bool surely_positive(const Expr& e) {
  const auto& a = e.operands();
  switch (e.op()) {
  case Op::constant:
    return e.value() > 0;
  case Op::exp:
    return true;
  case Op::add:
  case Op::multiply:
  case Op::divide:
  case Op::minimum:
    return surely_positive(a[0]) && surely_positive(a[1]);
  case Op::maximum:
    return surely_positive(a[0]) || surely_positive(a[1]);
  case Op::sqrt:
    return surely_positive(a[0]);
  case Op::where_le:
    return surely_positive(a[2]) && surely_positive(a[3]);
  default:
    return false;
  }
}

// Replaces 0 by 1 in a divisor; the dividend is 0 there as well.
Expr never_zero(const Expr& a) {
  return surely_positive(a) ? a : where_le(a, 0.0, where_le(0.0, a, 1.0, a), a);
}

// Derivative of a power e = a^b through its base only.
Expr base_slope(const Expr& e, const Expr& by_base) {
  const Expr &a = e.operands()[0], &b = e.operands()[1];
  if (b.is_constant(1)) return by_base;
  if (b.is_constant(2)) return times(2.0 * a, by_base);
  return is_zero(by_base) ? Expr(0.0) : times(b * e / never_zero(a), by_base);
}

Expr power_slope(const Expr& e, const Expr& by_base, const Expr& by_exponent) {
  const Expr& a = e.operands()[0];
  const Expr slope = base_slope(e, by_base);
  if (is_zero(by_exponent)) return slope;
  const Expr by_b =
      surely_positive(a) ? e * log(a) : where_le(a, 0.0, 0.0, e * log(where_le(a, 0.0, 1.0, a)));
  return slope + times(by_b, by_exponent);
}

Expr root_bounded(const Expr& root) {
  return surely_positive(root) ? root : maximum(root, least_root);
}

class Tangents {
public:
  explicit Tangents(const std::string& symbol) : symbol_(symbol) {}

  Expr of(const Expr& e) {
    if (const auto found = done_.find(e.id()); found != done_.end()) return found->second;
    const Expr d = compute(e);
    done_.emplace(e.id(), d);
    return d;
  }

private:
  Expr compute(const Expr& e) {
    const auto& a = e.operands();
    switch (e.op()) {
    case Op::constant:
      return 0.0;
    case Op::symbol:
      return e.name() == symbol_ ? 1.0 : 0.0;
    case Op::negate:
      return minus(0.0, of(a[0]));
    case Op::add:
      return of(a[0]) + of(a[1]);
    case Op::subtract:
      return minus(of(a[0]), of(a[1]));
    case Op::multiply:
      return times(of(a[0]), a[1]) + times(a[0], of(a[1]));
    case Op::divide:
      return over(minus(of(a[0]), times(e, of(a[1]))), a[1]);
    case Op::power:
      return power_slope(e, of(a[0]), of(a[1]));
    default:
      return function(e, a);
    }
  }

  Expr function(const Expr& e, const std::vector<Expr>& a) {
    const auto inner = [&] { return of(a[0]); };
    switch (e.op()) {
    case Op::exp:
      return times(e, inner());
    case Op::log:
      return over(inner(), a[0]);
    case Op::sqrt:
      return over(times(0.5, inner()), root_bounded(e));
    case Op::sin: // formulas have no cos
      return is_zero(inner()) ? Expr(0.0) : times(sin(a[0] + std::numbers::pi / 2), inner());
    case Op::tanh:
      return times(1.0 - e * e, inner());
    case Op::acos:
      return over(minus(0.0, inner()), root_bounded(sqrt(1.0 - a[0] * a[0])));
    case Op::minimum:
      return chosen(a[0], a[1], of(a[0]), of(a[1]));
    case Op::maximum:
      return chosen(a[1], a[0], of(a[0]), of(a[1]));
    default:
      return chosen(a[0], a[1], of(a[2]), of(a[3]));
    }
  }

  const std::string& symbol_;
  std::unordered_map<const Expr::Node*, Expr> done_;
};

} // namespace

Expr derivative(const Expr& formula, const std::string& symbol) {
  Tangents tangents(symbol);
  inside_out(formula, [&](const Expr& e) { tangents.of(e); });
  return tangents.of(formula);
}

std::vector<Expr> derivatives(const Expr& formula, const std::vector<std::string>& symbols) {
  std::vector<Expr> out;
  for (const std::string& symbol : symbols)
    out.push_back(derivative(formula, symbol));
  return out;
}

} // namespace frictab::expr
