// The Fortran sources of USRBCC, and of the routine that USRUPD calls for it, for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/coefficient.h"
#include "codegen/driven_path.h"
#include "codegen/solver_inputs.h"

namespace frictab::deform::usrbcc {

// Returns the choice in the job's [export.options]: mu, m or tau_R.
codegen::fortran::Coefficient coefficient_kind(const codegen::ExportRequest& request);

// States in USRBCC's arguments and COMMON blocks.
const codegen::SolverGives& gives(const codegen::ExportRequest&);

// True if the law takes the history of a node.
bool takes_history(const std::vector<codegen::SolverInput>& inputs);

// Number of USRNOD variables for it: slip, work, peak pressure and those of codegen/histories.h.
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// Throws InputError if a field has the number of a history.
void check_fields(const codegen::ExportRequest&, const std::vector<codegen::SolverInput>& inputs);

// Returns ftquit of fortran::Core.
std::string quit();

// Drives both routines with their account.
void follow(codegen::DrivenPath& path);

std::string usrbcc_source(const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs);
std::string usrupd_source(const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::deform::usrbcc
