// Derivatives of formulas as formulas again, for generated code.
#pragma once

#include <string>
#include <vector>

#include "expr/expr.h"

namespace frictab::expr {

// d formula/d symbol. Where a branch is chosen (minimum, maximum, where) it is that branch's, by
// the same comparison that Program's reverse sweep makes, so that at a kink both give the same
// one-sided derivative; an infinite slope of the branch not taken never reaches the result. As
// there, a power's slope is 0 where its base is 0. The infinite slopes of sqrt at 0 and of acos at
// -1 and 1 are cut off at some 1e150, so that nothing is divided by zero.
Expr derivative(const Expr& formula, const std::string& symbol);

// One per symbol.
std::vector<Expr> derivatives(const Expr& formula, const std::vector<std::string>& symbols);

} // namespace frictab::expr
