// Formulas as MathML, which browsers typeset without any script.
#pragma once

#include <functional>
#include <string>

#include "expr/expr.h"

namespace frictab::expr {

// Content of <math>. `symbol` returns the MathML of a name, such as <mi>&#956;</mi>, and has to
// escape text from outside. Divisions become fractions, powers superscripts, where_le two cases.
std::string mathml(const Expr& formula,
                   const std::function<std::string(const std::string&)>& symbol);

} // namespace frictab::expr
