// A formula in the coordinates of a table's axes: on a logarithmic axis the symbol means ln x, and
// logarithms and exponentials cancel as far as possible.
#pragma once

#include <set>
#include <string>

#include "expr/expr.h"

namespace frictab::expr {

// `formula` with x = exp(symbol x) for every name in `logarithmic`. The result equals the formula
// in exact arithmetic wherever the formula is defined; powers other than small integers become
// exponentials of logarithms.
Expr in_coordinates(const Expr& formula, const std::set<std::string>& logarithmic);

// ln of a formula that is already in coordinates, with logarithms moved inwards.
Expr log_in_coordinates(const Expr& formula);

} // namespace frictab::expr
