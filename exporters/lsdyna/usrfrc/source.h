// The Fortran source of USRFRC for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/driven_path.h"
#include "codegen/solver_inputs.h"

namespace frictab::lsdyna::usrfrc {

// States in USRFRC's arguments.
const codegen::SolverGives& gives(const codegen::ExportRequest&);
inline constexpr std::size_t before_histories = 6; // in UFHIST

// Number of values in UFHIST per node that the routine keeps: 6, two for each of
// codegen/histories.h, and, for output, the frictional shear stress and its share of the pressure.
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// Returns ftquit of fortran::Core.
std::string quit();

// Drives the routine with its account.
void follow(codegen::DrivenPath& path);

std::string usrfrc_source(const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::lsdyna::usrfrc
