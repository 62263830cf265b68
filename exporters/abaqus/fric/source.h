// The Fortran source of FRIC for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/driven_path.h"
#include "codegen/solver_inputs.h"

namespace frictab::abaqus::fric {

// States in FRIC's arguments.
const codegen::SolverGives& gives(const codegen::ExportRequest&);

// Number of values kept for every law, and for a law with these inputs, excluding those that
// protect them against iterations.
inline constexpr std::size_t history = 7;
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// The property after those of the states.
codegen::FurtherProperties critical_slip(const codegen::ExportRequest& request,
                                         const std::vector<codegen::SolverInput>& inputs);

// Drives the routine with its account.
void follow(codegen::DrivenPath& path);

std::string fric_source(const codegen::ExportRequest& request,
                        const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::abaqus::fric
