// The Fortran source of FRIC_COEF for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/driven_path.h"
#include "codegen/solver_inputs.h"

namespace frictab::abaqus::fric_coef {

// True if the request wants the argument list of 2024, false for that of 2020.
bool is_2024(const codegen::ExportRequest& request);

// States in that argument list.
const codegen::SolverGives& gives(const codegen::ExportRequest& request);

// Number of values kept for every law, and for a law with these inputs, excluding those that
// protect them against iterations. Only with the list of 2024.
inline constexpr std::size_t history = 5;
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// Head of the entry: argument list and its declarations.
std::string arguments(const codegen::ExportRequest& request);

// Throws InputError if the coefficient has to be kept and the argument list has no state variables.
std::string coef_source(const codegen::ExportRequest& request,
                        const std::vector<codegen::SolverInput>& inputs);

// Drives the routine with its account.
void follow(codegen::DrivenPath& path);

} // namespace frictab::abaqus::fric_coef
