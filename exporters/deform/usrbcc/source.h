// The Fortran sources of USRBCC, and of what USRUPD calls for it, for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/coefficient.h"
#include "codegen/solver_inputs.h"

namespace frictab::deform::usrbcc {

// What the job's [export.options] say: mu, m or tau_R.
codegen::fortran::Coefficient coefficient_kind(const codegen::ExportRequest& request);

// What USRBCC's arguments and COMMON blocks hold.
const codegen::SolverGives& gives(const codegen::ExportRequest&);

// Whether the law takes the history of a node.
bool takes_history(const std::vector<codegen::SolverInput>& inputs);

// USRNOD(1..n) that then hold it: slip, work, peak pressure and those of codegen/histories.h.
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// Throws InputError where a field's number is one of the histories.
void check_fields(const codegen::ExportRequest&, const std::vector<codegen::SolverInput>& inputs);

// ftquit of fortran::Core.
std::string quit();

std::string usrbcc_source(const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs);
std::string usrupd_source(const codegen::ExportRequest& request,
                          const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::deform::usrbcc
