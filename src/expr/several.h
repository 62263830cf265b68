// Several formulas taken together: what they have in common is stored, and computed, once.
#pragma once

#include <vector>

#include "expr/expr.h"

namespace frictab::expr {

// The same formulas with equal subformulas, of one or of different ones, stored once.
std::vector<Expr> shared(const std::vector<Expr>& formulas);

} // namespace frictab::expr
