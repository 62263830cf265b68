// Keyword lines of the input deck that all targets for Abaqus share.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_inputs.h"

namespace frictab::abaqus {

// "*Surface Interaction, name=FRICTAB", "*Friction, <user>, depvar=<depvar>, properties=<n>" and
// its data lines, 8 values each. `user` as the keyword has it: "user", "user=friction"; DEPVAR and
// PROPERTIES are left out where they are 0.
std::string friction_lines(const std::string& user, std::size_t depvar,
                           const std::vector<codegen::SolverInput>& inputs);

// The numbers of property lines, eight to a line.
std::string property_deck(const std::vector<std::string>& values);

} // namespace frictab::abaqus
