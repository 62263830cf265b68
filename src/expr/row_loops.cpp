// Forward and backward loops of every operation.
#include "expr/row_loops.h"

#include <cmath>

#include "core/wide.h"
#include "expr/arithmetic.h"

namespace frictab::expr {

double partial(Op op, std::size_t which, const double* v, double result) {
  switch (op) {
  case Op::negate:
    return -1;
  case Op::add:
    return 1;
  case Op::subtract:
    return which == 0 ? 1 : -1;
  case Op::multiply:
    return which == 0 ? v[1] : v[0];
  case Op::divide:
    return which == 0 ? 1 / v[1] : -result / v[1];
  case Op::power:
    if (which == 0 && v[0] == 0) return v[1] == 1 ? 1 : 0;
    if (which == 0) return v[1] * result / v[0];
    return v[0] > 0 ? result * std::log(v[0]) : 0;
  case Op::exp:
    return result;
  case Op::log:
    return 1 / v[0];
  case Op::sqrt:
    return 0.5 / result;
  case Op::sin:
    return std::cos(v[0]);
  case Op::tanh:
    return 1 - result * result;
  case Op::acos:
    return -1 / std::sqrt(1 - v[0] * v[0]);
  case Op::minimum:
    return (v[1] < v[0]) == (which == 1) ? 1 : 0;
  case Op::maximum:
    return (v[1] > v[0]) == (which == 1) ? 1 : 0;
  case Op::where_le:
    return which >= 2 && (v[0] <= v[1]) == (which == 2) ? 1 : 0;
  case Op::constant:
  case Op::symbol:
    break;
  }
  return 0;
}

namespace {

template <class F> FRICTAB_INLINE void unary(std::size_t n, Register a, double* out, F f) {
  if (a.stride == 1)
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(a.data[i]);
  else
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(*a.data);
}

template <class F>
FRICTAB_INLINE void binary(std::size_t n, Register a, Register b, double* out, F f) {
  if (a.stride == 1 && b.stride == 1)
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(a.data[i], b.data[i]);
  else if (a.stride == 1)
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(a.data[i], *b.data);
  else
    for (std::size_t i = 0; i < n; ++i)
      out[i] = f(*a.data, b[i]);
}

// to = f(i) for the first contribution, which then needs no zeros to add to; otherwise to + f(i).
template <class F> FRICTAB_INLINE void put(std::size_t n, double* to, bool add, F f) {
  if (add)
    for (std::size_t i = 0; i < n; ++i)
      to[i] += f(i);
  else
    for (std::size_t i = 0; i < n; ++i)
      to[i] = f(i);
}

template <class F>
FRICTAB_INLINE void put_times(std::size_t n, double* to, bool add, Register factor, F f) {
  if (factor.stride == 0)
    put(n, to, add, [f, x = *factor.data](std::size_t i) { return f(i, x); });
  else
    put(n, to, add, [f, x = factor.data](std::size_t i) { return f(i, x[i]); });
}

// Passes the adjoint to this operand in the rows in which it was chosen.
template <class F>
FRICTAB_INLINE void put_chosen(std::size_t n, double* to, bool add, Register a, Register b,
                               const double* adjoint, F chosen) {
  if (a.stride == 1 && b.stride == 1)
    put(n, to, add, [=](std::size_t i) { return chosen(a.data[i], b.data[i]) ? adjoint[i] : 0.0; });
  else if (a.stride == 1)
    put(n, to, add,
        [=, y = *b.data](std::size_t i) { return chosen(a.data[i], y) ? adjoint[i] : 0.0; });
  else
    put(n, to, add, [=](std::size_t i) { return chosen(a[i], b[i]) ? adjoint[i] : 0.0; });
}

} // namespace

FRICTAB_WIDE void run_operation(Op op, std::size_t n, const Operands& operands, double* out) {
  const Register* r = operands.r;
  switch (op) { // the compiler vectorises the loops of the cheap operations
  case Op::add:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a + b; });
  case Op::subtract:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a - b; });
  case Op::multiply:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a * b; });
  case Op::divide:
    return binary(n, r[0], r[1], out, [](double a, double b) { return a / b; });
  case Op::minimum:
    return binary(n, r[0], r[1], out, min_nan);
  case Op::maximum:
    return binary(n, r[0], r[1], out, max_nan);
  case Op::negate:
    return unary(n, r[0], out, [](double a) { return -a; });
  case Op::exp:
    return unary(n, r[0], out, [](double a) { return std::exp(a); });
  case Op::log:
    return unary(n, r[0], out, [](double a) { return std::log(a); });
  case Op::tanh:
    return unary(n, r[0], out, [](double a) { return hyperbolic_tangent(a); });
  default:
    break;
  }
  for (std::size_t i = 0; i < n; ++i)
    out[i] = apply(op, r[0][i], r[1][i], r[2][i], r[3][i]);
}

FRICTAB_WIDE void pass_back(Op op, std::size_t which, std::size_t n, const Operands& operands,
                            const double* result, const double* adjoint, double* to, bool add) {
  const Register* r = operands.r;
  const double* a = adjoint;
  switch (op) {
  case Op::add:
    return put(n, to, add, [a](std::size_t i) { return a[i]; });
  case Op::negate:
    return put(n, to, add, [a](std::size_t i) { return -a[i]; });
  case Op::subtract:
    if (which == 0) return put(n, to, add, [a](std::size_t i) { return a[i]; });
    return put(n, to, add, [a](std::size_t i) { return -a[i]; });
  case Op::multiply:
    return put_times(n, to, add, r[1 - which], [a](std::size_t i, double x) { return a[i] * x; });
  case Op::exp:
    return put(n, to, add, [a, result](std::size_t i) { return a[i] * result[i]; });
  case Op::tanh:
    return put(n, to, add,
               [a, result](std::size_t i) { return a[i] * (1 - result[i] * result[i]); });
  case Op::divide:
    if (which == 0)
      return put_times(n, to, add, r[1],
                       [a](std::size_t i, double x) { return a[i] == 0 ? 0.0 : a[i] / x; });
    return put_times(n, to, add, r[1], [a, result](std::size_t i, double x) {
      return a[i] == 0 ? 0.0 : -a[i] * result[i] / x;
    });
  case Op::log:
    return put_times(n, to, add, r[0],
                     [a](std::size_t i, double x) { return a[i] == 0 ? 0.0 : a[i] / x; });
  case Op::minimum:
    if (which == 1)
      return put_chosen(n, to, add, r[0], r[1], a, [](double x, double y) { return y < x; });
    return put_chosen(n, to, add, r[0], r[1], a, [](double x, double y) { return !(y < x); });
  case Op::maximum:
    if (which == 1)
      return put_chosen(n, to, add, r[0], r[1], a, [](double x, double y) { return y > x; });
    return put_chosen(n, to, add, r[0], r[1], a, [](double x, double y) { return !(y > x); });
  case Op::where_le:
    if (which == 2)
      return put_chosen(n, to, add, r[0], r[1], a, [](double x, double y) { return x <= y; });
    return put_chosen(n, to, add, r[0], r[1], a, [](double x, double y) { return !(x <= y); });
  default:
    break;
  }
  put(n, to, add, [&](std::size_t i) {
    if (a[i] == 0) return 0.0;
    const double v[4] = {r[0][i], r[1][i], r[2][i], r[3][i]};
    return a[i] * partial(op, which, v, result[i]);
  });
}

} // namespace frictab::expr
