// The Lua source of one table, or of the law itself.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab::qform::lua {

// What the wrapper is called with (names recalled), and the rest as QForm parameters.
const SolverGives& gives();

std::string lua_source(const ExportRequest& request, const std::vector<SolverInput>& inputs);

} // namespace frictab::qform::lua
