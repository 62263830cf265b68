// Calls VFRIC_COEF as Abaqus/Explicit does, with blocks of contact points.
#pragma once

#include "codegen/solver_inputs.h"

namespace frictab::abaqus_vfric_coef {

// tau_R is the coefficient times the pressure, as the solver forms its limit.
void drive(const Built& built, const SolverGives& gives, const ExportRequest& request,
           std::size_t rows, std::span<const double* const> columns, std::span<double> tau);

} // namespace frictab::abaqus_vfric_coef
