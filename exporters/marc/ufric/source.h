// The Fortran source of UFRIC for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/coefficient.h"
#include "codegen/solver_inputs.h"

namespace frictab::marc::ufric {

// Choices in the job's [export.options].
struct Choices {
  codegen::fortran::Coefficient coefficient; // coulomb | shear
  bool by_force;                             // FN is a force
  int slip_components;                       // VREL: 1 in 2-D, 2 in 3-D
};
Choices choices(const codegen::ExportRequest& request);

// States in UFRIC's arguments.
const codegen::SolverGives& gives(const codegen::ExportRequest& request);

// Head of the entry: argument list and its declarations; and ftquit.
std::string arguments(const codegen::ExportRequest& request);
std::string quit();

// Throws InputError if FN is a force and the coefficient depends on the pressure.
std::string ufric_source(const codegen::ExportRequest& request,
                         const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::marc::ufric
