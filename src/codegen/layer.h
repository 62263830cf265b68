// Finds the hidden layer of a network in its formula, so that generated code can run it as loops
// over arrays of weights instead of thousands of scalar statements, which no compiler vectorises.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::codegen {

// output_m = offset[m] + sum over its units of gain[u] tanh(bias[u] + sum_f weight[f][u]
// feature_f). Unit u belongs to output u % outputs: neighbours belong to different outputs, so that
// sums over units run in parallel and keep the formula's own order.
struct UnitLayer {
  std::vector<expr::Expr> features;
  std::size_t outputs = 0;
  std::vector<std::vector<double>> weight;
  std::vector<double> bias, gain;
  std::vector<double> offset;

  std::size_t units() const { return bias.size(); }
  std::size_t numbers() const; // weights, biases, gains, offsets
};

struct LayeredFormula {
  std::optional<UnitLayer> layer; // from `least_units` tanh on that are sums of the same features
  expr::Expr rest;                // the formula, with layer_output(m) in place of each output
};

inline constexpr std::size_t least_units = 6;

std::string layer_output(std::size_t m); // a symbol

LayeredFormula split_layer(const expr::Expr& formula);

// Different numbers in a formula.
std::size_t count_numbers(const expr::Expr& formula);

} // namespace frictab::codegen
