// Loops over the rows of a block, one per operation, forward and backward, written so that the
// compiler vectorises the cheap ones. Gives the same bits as `apply` in each row.
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

// Operands of an operation; unused ones read zero.
struct Operands {
  static constexpr double zero = 0;
  Register r[4] = {{&zero, 0}, {&zero, 0}, {&zero, 0}, {&zero, 0}};
};

// out[i] = op(operands in row i), i < n.
void run_operation(Op op, std::size_t n, const Operands& operands, double* out);

// to[i] = adjoint[i] * d op/d operand `which` in row i, or adds this product to to[i] if `add` is
// set. `result` is the result of the operation. If the adjoint is 0 the product is 0, even for an
// infinite slope, so the branch not taken contributes nothing.
void pass_back(Op op, std::size_t which, std::size_t n, const Operands& operands,
               const double* result, const double* adjoint, double* to, bool add);

// Derivative of an operation by operand `which`, given operand values and the result.
double partial(Op op, std::size_t which, const double* v, double result);

} // namespace frictab::expr
