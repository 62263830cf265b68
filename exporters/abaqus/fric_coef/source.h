// The Fortran source of FRIC_COEF for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab::abaqus::fric_coef {

// Whether the request wants the argument list of 2024, else that of 2020.
bool is_2024(const codegen::ExportRequest& request);

// What that argument list holds.
const codegen::SolverGives& gives(const codegen::ExportRequest& request);

// Values that are kept for every law, and for one with these inputs; without what protects them.
// Only with the list of 2024.
inline constexpr std::size_t history = 5;
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// The head of the entry: argument list and its declarations.
std::string arguments(const codegen::ExportRequest& request);

// Throws InputError where the coefficient shall be kept by an argument list without state
// variables.
std::string coef_source(const codegen::ExportRequest& request,
                        const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::abaqus::fric_coef
