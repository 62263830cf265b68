// Calls VFRICTION as Abaqus/Explicit does, with blocks of contact points.
#pragma once

#include "codegen/solver_inputs.h"

namespace frictab::abaqus_vfriction {

void drive(const Built& built, const SolverGives& gives, const ExportRequest& request,
           std::size_t rows, std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::abaqus_vfriction
