// Laws as JavaScript functions, for pages that evaluate them.
#pragma once

#include <string>

#include "models/assembled_law.h"

namespace frictab::codegen {

// Returns "function (sigma_n_MPa, psi) { ... }": tau_R in MPa of the law's inputs, in their order
// and canonical units, by its own formula with its parameters as numbers and the shear limit. Calls
// Math and the helpers of javascript_helpers(). The operations are those of C in their order; Math
// may round exp, log and pow otherwise in the last digit.
std::string javascript_function(const models::AssembledLaw& law);

// Returns the declarations of ft_min, ft_max and ft_where_le (NaN as in expr/expr.h), exp, log, ...
std::string javascript_helpers();

} // namespace frictab::codegen
