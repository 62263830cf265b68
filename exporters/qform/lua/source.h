// The Lua source of one table, or of the law itself.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab::qform::lua {

// States in the arguments of the wrapper (names recalled), and the rest as QForm parameters.
const codegen::SolverGives& gives();

std::string lua_source(const codegen::ExportRequest& request,
                       const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::qform::lua
