// Finds the hidden layer of a network in its formula, so that generated code can run it as loops
// over arrays of weights instead of thousands of scalar statements, which compilers do not
// vectorise.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::codegen {

// A layer: output_m = offset[m] + sum over its units of gain[u] tanh(bias[u] + sum_f weight[f][u]
// feature_f). Unit u belongs to output u % outputs: neighbouring units belong to different outputs,
// so that sums over units run in parallel and keep the formula's own order.
struct UnitLayer {
  std::vector<expr::Expr> features;
  std::size_t outputs = 0;
  std::vector<std::vector<double>> weight;
  std::vector<double> bias, gain;
  std::vector<double> offset;

  std::size_t units() const { return bias.size(); }
  std::size_t numbers() const; // count of weights, biases, gains, offsets
};

struct LayeredFormula {
  // Present from `least_units` tanh on, if all are of sums of the same features.
  std::optional<UnitLayer> layer;
  expr::Expr rest; // the formula, with layer_output(m) in place of each output
};

inline constexpr std::size_t least_units = 6;

std::string layer_output(std::size_t m); // name of a symbol

LayeredFormula split_layer(const expr::Expr& formula);

// Counts the distinct numbers in a formula.
std::size_t count_numbers(const expr::Expr& formula);

} // namespace frictab::codegen
