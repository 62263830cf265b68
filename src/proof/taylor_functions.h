// Polynomials that approximate smooth functions of one variable, with an error bound.
#pragma once

#include <span>

#include "expr/expr.h"

namespace frictab::proof {

// Over centre - radius .. centre + radius: op(centre + radius y) is within the returned error of
// sum_n c[n] y^n, |y| <= 1. Interpolation at Chebyshev points, whose error is at most max|f^(n+1)|
// / (n+1)! radius^(n+1) / 2^n (Davis 1975, 3.3), plus rounding. Infinite if `op` is none of exp,
// log, sqrt, sin, tanh and 1/y (Op::divide), or is not smooth over the interval.
double chebyshev_fit(expr::Op op, double centre, double radius, std::span<double> c);

} // namespace frictab::proof
