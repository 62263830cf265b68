// A formula as MathML, which browsers set as mathematics without any script.
#pragma once

#include <functional>
#include <string>

#include "expr/expr.h"

namespace frictab::expr {

// What stands inside <math>. `symbol` gives the MathML of a name: <mi>&#956;</mi>; it has to escape
// what it takes from outside. Divisions are fractions, powers superscripts, where_le two cases.
std::string mathml(const Expr& formula,
                   const std::function<std::string(const std::string&)>& symbol);

} // namespace frictab::expr
