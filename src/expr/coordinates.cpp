// Combines products of exponentials into one exponential, and splits logarithms of products into
// sums.
#include "expr/coordinates.h"

#include <cmath>
#include <optional>
#include <unordered_map>

namespace frictab::expr {

namespace {

// factor * exp(exponent)
struct Monomial {
  double factor;
  Expr exponent;
};

std::optional<Monomial> monomial(const Expr& e) {
  if (e.op() == Op::constant) return Monomial{e.value(), 0.0};
  if (e.op() == Op::exp) return Monomial{1, e.operands()[0]};
  if (e.op() == Op::multiply && e.operands()[0].op() == Op::constant &&
      e.operands()[1].op() == Op::exp)
    return Monomial{e.operands()[0].value(), e.operands()[1].operands()[0]};
  return std::nullopt;
}

Expr formula_of(const Monomial& m) {
  return m.exponent.op() == Op::constant ? Expr(m.factor * std::exp(m.exponent.value()))
                                         : Expr(m.factor) * exp(m.exponent);
}

bool positive(const Expr& e) {
  const auto all = [&](std::size_t from) {
    for (std::size_t i = from; i < e.operands().size(); ++i)
      if (!positive(e.operands()[i])) return false;
    return true;
  };
  switch (e.op()) {
  case Op::constant:
    return e.value() > 0;
  case Op::exp:
    return true;
  case Op::multiply:
  case Op::divide:
  case Op::minimum:
  case Op::sqrt:
    return all(0);
  case Op::maximum:
    return positive(e.operands()[0]) || positive(e.operands()[1]);
  case Op::where_le:
    return all(2);
  default:
    return false;
  }
}

Expr log_of(const Expr& e) {
  if (!positive(e)) return log(e);
  const auto& a = e.operands();
  switch (e.op()) {
  case Op::exp:
    return a[0];
  case Op::multiply:
    return log_of(a[0]) + log_of(a[1]);
  case Op::divide:
    return log_of(a[0]) - log_of(a[1]);
  case Op::minimum:
    return minimum(log_of(a[0]), log_of(a[1]));
  case Op::maximum:
    return positive(a[0]) && positive(a[1]) ? maximum(log_of(a[0]), log_of(a[1])) : log(e);
  case Op::sqrt:
    return 0.5 * log_of(a[0]);
  case Op::where_le:
    return where_le(a[0], a[1], log_of(a[2]), log_of(a[3]));
  default:
    return log(e); // a constant
  }
}

Expr power(const Expr& base, const Expr& exponent) {
  if (exponent.op() == Op::constant) {
    if (exponent.value() == 1) return base;
    if (exponent.value() == 2) return base * base;
    if (exponent.value() == 0.5) return sqrt(base);
  }
  return exp(exponent * log_of(base));
}

Expr with_monomials(Op op, const std::vector<Expr>& a) {
  const auto first = a.empty() ? std::nullopt : monomial(a[0]);
  const auto second = a.size() < 2 ? std::nullopt : monomial(a[1]);
  switch (op) {
  case Op::negate:
    return first ? formula_of({-first->factor, first->exponent}) : -a[0];
  case Op::multiply:
    if (first && second)
      return formula_of({first->factor * second->factor, first->exponent + second->exponent});
    return a[0] * a[1];
  case Op::divide:
    if (first && second && second->factor != 0)
      return formula_of({first->factor / second->factor, first->exponent - second->exponent});
    return second && second->factor != 0
               ? a[0] * formula_of({1 / second->factor, -second->exponent})
               : a[0] / a[1];
  case Op::power:
    return power(a[0], a[1]);
  case Op::log:
    return log_of(a[0]);
  default:
    return rebuild(op, a);
  }
}

using Done = std::unordered_map<const Expr::Node*, Expr>;

Expr rewrite(const Expr& formula, const std::set<std::string>& logarithmic) {
  Done done;
  inside_out(formula, [&](const Expr& e) {
    Expr result = e;
    if (e.op() == Op::symbol) {
      if (logarithmic.count(e.name())) result = exp(e);
    } else if (!e.operands().empty()) {
      std::vector<Expr> operands;
      for (const Expr& operand : e.operands())
        operands.push_back(done.at(operand.id()));
      result = with_monomials(e.op(), operands);
    }
    done.emplace(e.id(), result);
  });
  return done.at(formula.id());
}

} // namespace

Expr in_coordinates(const Expr& formula, const std::set<std::string>& logarithmic) {
  return shared(rewrite(formula, logarithmic));
}

Expr log_in_coordinates(const Expr& formula) {
  return shared(with_monomials(Op::log, {formula}));
}

} // namespace frictab::expr
