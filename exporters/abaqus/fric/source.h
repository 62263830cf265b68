// The Fortran source of FRIC for one table.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab::abaqus::fric {

// What FRIC's arguments hold.
const codegen::SolverGives& gives(const codegen::ExportRequest&);

// Values that are kept for every law, and for one with these inputs; without what protects them.
inline constexpr std::size_t history = 7;
std::size_t state_count(const std::vector<codegen::SolverInput>& inputs);

// The property behind those of the states.
codegen::FurtherProperties critical_slip(const codegen::ExportRequest& request,
                                         const std::vector<codegen::SolverInput>& inputs);

std::string fric_source(const codegen::ExportRequest& request,
                        const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::abaqus::fric
