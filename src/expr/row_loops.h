// Loops over the rows of a block, one per operation, forward and backward: written so that the
// compiler vectorises the cheap ones. Row by row the same bits as `apply`.
#pragma once

#include <cstddef>

#include "expr/expr.h"

namespace frictab::expr {

// One value per row of the block, or one value for all rows (stride 0).
struct Register {
  const double* data = nullptr;
  std::size_t stride = 0;
  double operator[](std::size_t i) const { return data[i * stride]; }
};

// What an operation reads; unused operands read zero.
struct Operands {
  static constexpr double zero = 0;
  Register r[4] = {{&zero, 0}, {&zero, 0}, {&zero, 0}, {&zero, 0}};
};

// out[i] = op(operands in row i), i < n.
void run_operation(Op op, std::size_t n, const Operands& operands, double* out);

// to[i] = adjoint[i] * d op/d operand `which` in row i, or with `add` that much more. `result` is
// what the operation gave. Where the adjoint is 0 so is the product, however steep the operation:
// the branch not taken keeps its infinite slopes to itself.
void pass_back(Op op, std::size_t which, std::size_t n, const Operands& operands,
               const double* result, const double* adjoint, double* to, bool add);

// Derivative of an operation by operand `which`, given operand values and the result.
double partial(Op op, std::size_t which, const double* v, double result);

} // namespace frictab::expr
