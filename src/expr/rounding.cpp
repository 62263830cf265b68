// Carries value and error of every operation through a formula.
#include "expr/rounding.h"

#include <limits>
#include <vector>

namespace frictab::expr {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double largest_float = std::numeric_limits<float>::max();
constexpr double smallest_normal = std::numeric_limits<float>::min();
constexpr double own_rounding = 1 + 1e-12; // of this analysis, an operation

// Where the computed value lies.
Bounds computed(const SingleBound& a) {
  return outward(a.exact.low - a.error, a.exact.high + a.error);
}

// The error of an operation whose operands' errors change its exact result by `carried`.
SingleBound rounded(const Bounds& exact, double carried, double unit = single_roundoff) {
  const double size = exact.magnitude() + carried;
  const double error = (carried + unit * size + smallest_normal) * own_rounding;
  return {exact, size + error < largest_float ? error : unbounded};
}

SingleBound unknown() {
  return {whole_line, unbounded};
}

SingleBound product(const SingleBound& a, const SingleBound& b) {
  const double carried =
      a.exact.magnitude() * b.error + b.exact.magnitude() * a.error + a.error * b.error;
  return rounded(a.exact * b.exact, carried);
}

// |a'/b' - a/b| <= (|a' - a| + |a/b| |b' - b|)/|b'|
SingleBound quotient(const SingleBound& a, const SingleBound& b) {
  const Bounds divisor = computed(b);
  if (divisor.low <= 0 && divisor.high >= 0) return unknown();
  const double smallest = std::min(std::abs(divisor.low), std::abs(divisor.high));
  const Bounds exact = a.exact / b.exact;
  return rounded(exact, (a.error + exact.magnitude() * b.error) / smallest, single_library_error);
}

// A function of one operand whose slope is at most `slope` between true and computed operand.
SingleBound function(Op op, const SingleBound& a, double slope) {
  const double carried = a.error == 0 ? 0 : slope * a.error;
  return rounded(apply(op, a.exact, {}, {}, {}), carried, single_library_error);
}

SingleBound power(const SingleBound& a, const SingleBound& b) {
  const Bounds base = computed(a), exponent = computed(b);
  if (base.low <= 0) return unknown();
  const Bounds value = apply(Op::power, base, exponent, {}, {});
  const Bounds by_base = exponent * value / base;
  const Bounds by_exponent = value * apply(Op::log, base, {}, {}, {});
  return rounded(apply(Op::power, a.exact, b.exact, {}, {}),
                 by_base.magnitude() * a.error + by_exponent.magnitude() * b.error,
                 single_library_error);
}

SingleBound choice(Op op, const SingleBound& a, const SingleBound& b) {
  const Bounds x = computed(a), y = computed(b);
  const bool smaller = op == Op::minimum;
  if (x.high < y.low) return smaller ? a : b;
  if (y.high < x.low) return smaller ? b : a;
  return {apply(op, a.exact, b.exact, {}, {}), std::max(a.error, b.error)};
}

SingleBound where(const std::vector<SingleBound>& a) {
  const Bounds x = computed(a[0]), y = computed(a[1]);
  if (x.high <= y.low) return a[2];
  return y.high < x.low ? a[3] : unknown();
}

SingleBound unary(Op op, const SingleBound& a) {
  const Bounds x = computed(a);
  switch (op) {
  case Op::negate:
    return {apply(op, a.exact, {}, {}, {}), a.error};
  case Op::exp:
    return function(op, a, std::exp(x.high));
  case Op::log:
    return x.low > 0 ? function(op, a, 1 / x.low) : unknown();
  case Op::sqrt:
    return x.low > 0 ? function(op, a, 0.5 / std::sqrt(x.low)) : unknown();
  case Op::acos:
    if (x.magnitude() >= 1) return unknown();
    return function(op, a, 1 / std::sqrt(1 - x.magnitude() * x.magnitude()));
  default: // sin, tanh
    return function(op, a, 1);
  }
}

class Analysis {
public:
  explicit Analysis(const std::map<std::string, SingleBound>& symbols) : symbols_(symbols) {}

  SingleBound of(const Expr& e) {
    if (const auto known = done_.find(e.id()); known != done_.end()) return known->second;
    const SingleBound bound = of_new(e);
    done_.emplace(e.id(), bound);
    return bound;
  }

private:
  SingleBound of_new(const Expr& e) {
    if (e.op() == Op::symbol) return symbols_.at(e.name());
    if (e.op() == Op::constant) return rounded({e.value(), e.value()}, 0);
    std::vector<SingleBound> a;
    for (const Expr& operand : e.operands())
      a.push_back(of(operand));
    for (const SingleBound& operand : a)
      if (!std::isfinite(operand.error) && e.op() != Op::where_le) return unknown();
    switch (e.op()) {
    case Op::add:
      return rounded(a[0].exact + a[1].exact, a[0].error + a[1].error);
    case Op::subtract:
      return rounded(a[0].exact - a[1].exact, a[0].error + a[1].error);
    case Op::multiply:
      return product(a[0], a[1]);
    case Op::divide:
      return quotient(a[0], a[1]);
    case Op::power:
      return power(a[0], a[1]);
    case Op::minimum:
    case Op::maximum:
      return choice(e.op(), a[0], a[1]);
    case Op::where_le:
      return where(a);
    default:
      return unary(e.op(), a[0]);
    }
  }

  const std::map<std::string, SingleBound>& symbols_;
  std::map<const Expr::Node*, SingleBound> done_;
};

SingleBound leaf(const SingleSymbol& symbol, std::size_t piece, std::size_t pieces) {
  const Bounds& r = symbol.range;
  const double width = r.high - r.low, n = static_cast<double>(pieces);
  const Bounds part = outward(r.low + width * static_cast<double>(piece) / n,
                              r.low + width * static_cast<double>(piece + 1) / n);
  const double error = symbol.relative * part.magnitude() + symbol.absolute;
  return {part, part.magnitude() + error < largest_float ? error : unbounded};
}

constexpr std::size_t most_boxes = 4096, most_pieces = 16;

// Of each of `count` symbols.
std::size_t pieces_of(std::size_t count) {
  std::size_t pieces = most_pieces;
  while (pieces > 1 && std::pow(static_cast<double>(pieces), static_cast<double>(count)) >
                           static_cast<double>(most_boxes))
    --pieces;
  return pieces;
}

} // namespace

SingleBound bound_in_single(const Expr& formula,
                            const std::map<std::string, SingleSymbol>& symbols) {
  std::map<std::string, SingleBound> leaves;
  std::vector<std::string> split; // the others are numbers
  for (const std::string& name : expr::symbols(formula)) {
    leaves[name] = leaf(symbols.at(name), 0, 1);
    if (symbols.at(name).range.width() > 0) split.push_back(name);
  }
  const std::size_t pieces = pieces_of(split.size());
  std::size_t boxes = 1;
  for (std::size_t i = 0; i < split.size(); ++i)
    boxes *= pieces;
  SingleBound all{{unbounded, -unbounded}, 0};
  for (std::size_t box = 0; box < boxes; ++box) {
    std::size_t rest = box;
    for (const std::string& name : split) {
      leaves[name] = leaf(symbols.at(name), rest % pieces, pieces);
      rest /= pieces;
    }
    Analysis analysis(leaves);
    inside_out(formula, [&](const Expr& e) { analysis.of(e); });
    const SingleBound one = analysis.of(formula);
    all.exact = hull(all.exact, one.exact);
    all.error = std::max(all.error, one.error);
  }
  return all;
}

} // namespace frictab::expr
