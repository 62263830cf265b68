// Several formulas together: common subformulas are stored, and computed, once.
#pragma once

#include <vector>

#include "expr/expr.h"

namespace frictab::expr {

// The same formulas with equal subformulas, within one or across several, stored once.
std::vector<Expr> shared(const std::vector<Expr>& formulas);

} // namespace frictab::expr
