// The Fortran source of VFRIC for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab::abaqus_vfric {

// What VFRIC's arguments hold.
const SolverGives& gives();

std::string vfric_source(const ExportRequest& request, const std::vector<SolverInput>& inputs);

} // namespace frictab::abaqus_vfric
