// Recognises sums of tanh of sums, the form of every network with one hidden layer.
#include "codegen/layer.h"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "expr/derivative.h"

namespace frictab::codegen {

using expr::Expr;
using expr::Op;

namespace {

// A sum: constant + sum of factor * node, whose nodes are not sums themselves.
struct Sum {
  double constant = 0;
  std::vector<std::pair<Expr, double>> terms; // in the order of the formula
};

void add_term(Sum& sum, const Expr& node, double factor) {
  for (auto& [known, total] : sum.terms)
    if (known.id() == node.id()) {
      total += factor;
      return;
    }
  sum.terms.emplace_back(node, factor);
}

void collect(Sum& sum, const Expr& e, double factor) {
  const auto& a = e.operands();
  const auto is_number = [](const Expr& x) { return x.op() == Op::constant; };
  switch (e.op()) {
  case Op::constant:
    sum.constant += factor * e.value();
    return;
  case Op::add:
    collect(sum, a[0], factor);
    collect(sum, a[1], factor);
    return;
  case Op::subtract:
    collect(sum, a[0], factor);
    collect(sum, a[1], -factor);
    return;
  case Op::negate:
    collect(sum, a[0], -factor);
    return;
  case Op::multiply:
    if (is_number(a[0])) return collect(sum, a[1], factor * a[0].value());
    if (is_number(a[1])) return collect(sum, a[0], factor * a[1].value());
    break;
  case Op::divide:
    if (is_number(a[1])) return collect(sum, a[0], factor / a[1].value());
    break;
  default:
    break;
  }
  add_term(sum, e, factor);
}

Sum sum_of(const Expr& e) {
  Sum sum;
  collect(sum, e, 1);
  return sum;
}

// Finds the nodes of a formula that are sums of tanh and of nothing else.
class Outputs {
public:
  explicit Outputs(const Expr& formula) { visit(formula); }

  std::vector<std::pair<Expr, Sum>> found;
  bool regular = true; // every tanh is a term of one of them

private:
  void visit(const Expr& e) {
    if (!seen_.insert(e.id()).second) return;
    const Sum sum = sum_of(e);
    const auto is_tanh = [](const auto& term) { return term.first.op() == Op::tanh; };
    const auto units = std::count_if(sum.terms.begin(), sum.terms.end(), is_tanh);
    if (units > 0) {
      regular = regular && static_cast<std::size_t>(units) == sum.terms.size();
      found.emplace_back(e, sum);
      return;
    }
    for (const auto& [term, factor] : sum.terms)
      for (const Expr& operand : term.operands())
        visit(operand);
  }

  std::set<const Expr::Node*> seen_;
};

bool holds_tanh(const Expr& formula) {
  bool holds = false;
  for_each_part(formula, [&](const Expr& part) { holds = holds || part.op() == Op::tanh; });
  return holds;
}

// Adds one unit; returns false if its sum contains another unit, which would be a second layer.
bool add_unit(UnitLayer& layer, const Expr& unit, double gain) {
  const Sum sum = sum_of(unit.operands()[0]);
  const std::size_t u = layer.units();
  for (const auto& term : sum.terms) {
    const Expr& feature = term.first;
    if (holds_tanh(feature)) return false;
    const auto known = std::find_if(layer.features.begin(), layer.features.end(),
                                    [&](const Expr& f) { return f.id() == feature.id(); });
    const auto f = static_cast<std::size_t>(known - layer.features.begin());
    if (known == layer.features.end()) {
      layer.features.push_back(feature);
      layer.weight.emplace_back(u, 0.0);
    }
    layer.weight[f].resize(u, 0.0);
    layer.weight[f].push_back(term.second);
  }
  for (auto& weight : layer.weight)
    weight.resize(u + 1, 0.0);
  layer.bias.push_back(sum.constant);
  layer.gain.push_back(gain);
  return true;
}

std::optional<UnitLayer> layer_of(const Outputs& outputs) {
  if (!outputs.regular || outputs.found.empty()) return std::nullopt;
  const std::size_t per_output = outputs.found[0].second.terms.size();
  std::set<const Expr::Node*> used;
  UnitLayer layer;
  layer.outputs = outputs.found.size();
  for (std::size_t h = 0; h < per_output; ++h)
    for (const auto& [node, sum] : outputs.found) {
      if (sum.terms.size() != per_output) return std::nullopt;
      const auto& [unit, gain] = sum.terms[h];
      if (!used.insert(unit.id()).second || !add_unit(layer, unit, gain)) return std::nullopt;
    }
  for (const auto& [node, sum] : outputs.found)
    layer.offset.push_back(sum.constant);
  return layer;
}

} // namespace

std::size_t UnitLayer::numbers() const {
  return features.size() * units() + 2 * units() + outputs;
}

std::string layer_output(std::size_t m) {
  return fmt::format("layer output {}", m);
}

std::string layer_slope(std::size_t f) {
  return fmt::format("layer slope {}", f);
}

LayeredFormula split_layer(const Expr& formula) {
  const Expr whole = shared(formula);
  const Outputs outputs(whole);
  std::optional<UnitLayer> layer = layer_of(outputs);
  if (!layer || layer->units() < least_units) return {{}, whole};
  std::vector<std::pair<Expr, Expr>> nodes;
  for (const auto& [node, sum] : outputs.found)
    nodes.emplace_back(node, Expr::symbol(layer_output(nodes.size())));
  return {std::move(*layer), substitute(whole, nodes)};
}

Expr slope_by(const LayeredFormula& formula, const std::string& state) {
  Expr slope = derivative(formula.rest, state);
  for (std::size_t f = 0; f < formula.layer.features.size(); ++f) {
    const Expr inner = derivative(formula.layer.features[f], state);
    if (!inner.is_constant(0)) slope = slope + Expr::symbol(layer_slope(f)) * inner;
  }
  return slope;
}

std::size_t count_numbers(const Expr& formula) {
  std::set<double> numbers;
  for_each_part(formula, [&](const Expr& part) {
    if (part.op() == Op::constant) numbers.insert(part.value());
  });
  return numbers.size();
}

} // namespace frictab::codegen
