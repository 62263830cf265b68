// A formula in the coordinates of a table's axes: where an axis is logarithmic, its symbol means
// ln x, and logarithms and exponentials cancel as far as they can.
#pragma once

#include <set>
#include <string>

#include "expr/expr.h"

namespace frictab::expr {

// `formula` with x = exp(symbol x) for every name in `logarithmic`. The result equals the formula
// in exact arithmetic wherever the formula is defined; powers that are no small integers are
// exponentials of logarithms.
Expr in_coordinates(const Expr& formula, const std::set<std::string>& logarithmic);

// ln of a formula that is already in coordinates, with logarithms drawn inwards.
Expr log_in_coordinates(const Expr& formula);

} // namespace frictab::expr
