// Propagates ranges and slopes through a formula together.
#include "expr/sensitivity.h"

#include <stdexcept>
#include <unordered_map>

namespace frictab::expr {

namespace {

constexpr Bounds none{0, 0};

using Carried = Sensitivity::Result;

bool is_zero(const Bounds& slope) {
  return slope.low == 0 && slope.high == 0;
}

// Chain rule by the mean value theorem: slope of f over its operand's range, times the operand's
// slope.
Bounds chain(const Bounds& outer, const Bounds& inner) {
  return is_zero(inner) ? none : outer * inner;
}

Bounds root_slope(const Bounds& root) {
  return Bounds{1, 1} / (Bounds{2, 2} * root);
}

Bounds arc_slope(const Bounds& x) {
  const Bounds root = apply(Op::sqrt, Bounds{1, 1} - x * x, {}, {}, {});
  return Bounds{-1, -1} / root;
}

Bounds power_slope(const Carried& a, const Carried& b, const Bounds& result) {
  const Bounds by_base = chain(result * b.range / a.range, a.slope);
  const Bounds by_exponent = chain(result * apply(Op::log, a.range, {}, {}, {}), b.slope);
  return by_base + by_exponent;
}

// Slope of a choice between branches whose condition itself does not change.
Bounds branch_slope(const Carried& a, const Carried& b, const Carried& c, const Carried& d) {
  if (a.range.high <= b.range.low) return c.slope;
  if (b.range.high < a.range.low) return d.slope;
  return is_zero(a.slope) && is_zero(b.slope) ? hull(c.slope, d.slope) : whole_line;
}

// Slope `if_a` where a is the smaller operand, `if_b` where b is, or around both.
Bounds chosen_slope(const Carried& a, const Carried& b, const Bounds& if_a, const Bounds& if_b) {
  if (a.range.high <= b.range.low) return if_a;
  if (b.range.high <= a.range.low) return if_b;
  return hull(a.slope, b.slope);
}

Bounds slope_of(Op op, const Carried& a, const Carried& b, const Carried& c, const Carried& d,
                const Bounds& result) {
  switch (op) {
  case Op::negate:
    return {-a.slope.high, -a.slope.low};
  case Op::add:
    return a.slope + b.slope;
  case Op::subtract:
    return a.slope - b.slope;
  case Op::multiply:
    return chain(a.range, b.slope) + chain(b.range, a.slope);
  case Op::divide:
    return (a.slope - chain(result, b.slope)) / b.range;
  case Op::power:
    return power_slope(a, b, result);
  case Op::exp:
    return chain(result, a.slope);
  case Op::log:
    return chain(Bounds{1, 1} / a.range, a.slope);
  case Op::sqrt:
    return chain(root_slope(result), a.slope);
  case Op::sin:
    return chain({-1, 1}, a.slope);
  case Op::tanh:
    return chain(Bounds{1, 1} - result * result, a.slope);
  case Op::acos:
    return chain(arc_slope(a.range), a.slope);
  case Op::minimum:
    return chosen_slope(a, b, a.slope, b.slope);
  case Op::maximum:
    return chosen_slope(a, b, b.slope, a.slope);
  case Op::where_le:
    return branch_slope(a, b, c, d);
  case Op::constant:
  case Op::symbol:
    break;
  }
  return whole_line;
}

} // namespace

Sensitivity::Sensitivity(const Expr& formula, const std::vector<std::string>& columns,
                         const std::string& of) {
  std::unordered_map<const Expr::Node*, std::size_t> done;
  const auto index = [&](const std::string& name) {
    const auto found = std::ranges::find(columns, name);
    if (found == columns.end())
      throw std::logic_error("formula has the unknown symbol '" + name + "'");
    return static_cast<std::size_t>(found - columns.begin());
  };
  of_ = index(of);
  inside_out(formula, [&](const Expr& e) {
    Step step{.op = e.op()};
    if (e.op() == Op::constant) step.value = e.value();
    if (e.op() == Op::symbol) step.symbol = index(e.name());
    for (std::size_t i = 0; i < e.operands().size(); ++i)
      step.a[i] = done.at(e.operands()[i].id());
    step.changes = e.op() == Op::symbol && step.symbol == of_;
    for (std::size_t i = 0; i < e.operands().size(); ++i)
      step.changes = step.changes || steps_[step.a[i]].changes;
    steps_.push_back(step);
    done.emplace(e.id(), steps_.size() - 1);
  });
}

Sensitivity::Result Sensitivity::operator()(std::span<const Bounds> box) const {
  std::vector<Carried> at(steps_.size());
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    if (step.op == Op::constant) {
      at[i] = {{step.value, step.value}, none};
    } else if (step.op == Op::symbol) {
      at[i] = {box[step.symbol], step.changes ? Bounds{1, 1} : none};
    } else {
      const Carried &a = at[step.a[0]], &b = at[step.a[1]], &c = at[step.a[2]], &d = at[step.a[3]];
      at[i].range = apply(step.op, a.range, b.range, c.range, d.range);
      at[i].slope = step.changes ? slope_of(step.op, a, b, c, d, at[i].range) : none;
    }
  }
  return at.back();
}

} // namespace frictab::expr
