// Which rows of states a routine that keeps histories can be asked for.
#pragma once

#include <span>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab {

// False where a row contradicts itself as the state of a contact point: two sliding distances, or a
// peak pressure below the present one, which is `otherwise` (MPa) where the law takes none. Such a
// row is left as it is by a driver.
bool posed(const std::vector<SolverInput>& inputs, std::span<const double* const> columns,
           std::size_t row, double otherwise);

} // namespace frictab
