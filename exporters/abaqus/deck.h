// Keyword lines of the input deck that all targets for Abaqus share.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab::abaqus {

// Returns "*Surface Interaction, name=FRICTAB", "*Friction, <user>, depvar=<depvar>,
// properties=<n>" and its data lines, 8 values each, those of `inputs` before `further`. `user` as
// in the keyword: "user", "user=friction". DEPVAR and PROPERTIES are left out if they are 0.
std::string friction_lines(const std::string& user, std::size_t depvar,
                           const std::vector<codegen::SolverInput>& inputs,
                           const codegen::FurtherProperties& further = {});

// Returns the lines that define the field variables of the law, as comments and keywords; empty if
// the law takes none.
std::string field_lines(const std::vector<codegen::SolverInput>& inputs);

// Returns the lines after friction_lines for contact pairs of Abaqus/Standard.
std::string standard_lines(const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::abaqus
