// How drivers put rows of states into calls.
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

// These rows in groups that can share a call, at most `most` each: properties are constants of a
// call, so all rows of a group agree in them.
std::vector<std::vector<std::size_t>> call_groups(const std::vector<SolverInput>& inputs,
                                                  std::vector<std::size_t> rows,
                                                  std::span<const double* const> columns,
                                                  std::size_t most);

} // namespace frictab
