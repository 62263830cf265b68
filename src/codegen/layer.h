// Finds the hidden layer of a network in its formula, so that generated code can run it as loops
// over arrays of weights instead of thousands of scalar statements, which compilers do not
// vectorise.
#pragma once

#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::codegen {

// A layer, empty if there is none: output_m = offset[m] + sum over its units of gain[u]
// tanh(bias[u] + sum_f weight[f][u] feature_f). Unit u belongs to output u % outputs: neighbouring
// units belong to different outputs, so that sums over units run in parallel and keep the formula's
// own order.
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
  // There is one from `least_units` tanh on, if all are of sums of the same features.
  UnitLayer layer;
  expr::Expr rest; // the formula, with layer_output(m) in place of each output

  bool has_layer() const { return layer.units() > 0; }
};

inline constexpr std::size_t least_units = 6;

// Symbols for an output, and for the derivative of the result by the weighted sum of feature f's
// units.
std::string layer_output(std::size_t m);
std::string layer_slope(std::size_t f);

LayeredFormula split_layer(const expr::Expr& formula);

// Returns the derivative by a state: of the formula after the layer, and through its features.
expr::Expr slope_by(const LayeredFormula& formula, const std::string& state);

// Counts the distinct numbers in a formula.
std::size_t count_numbers(const expr::Expr& formula);

} // namespace frictab::codegen
