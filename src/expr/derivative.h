// Derivatives of formulas as formulas, for generated code.
#pragma once

#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::expr {

// d formula/d symbol. For minimum, maximum and where, this is the derivative of the chosen branch,
// by the same comparison as in Program's reverse sweep, so that both give the same one-sided
// derivative at a kink; an infinite slope of the branch not taken never reaches the result. As in
// Program, the slope of a power is 0 where its base is 0. The infinite slopes of sqrt at 0 and of
// acos at -1 and 1 are limited to about 1e150, so that nothing is divided by zero.
Expr derivative(const Expr& formula, const std::string& symbol);

// One derivative per symbol.
std::vector<Expr> derivatives(const Expr& formula, const std::vector<std::string>& symbols);

} // namespace frictab::expr
