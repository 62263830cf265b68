// What all targets for Abaqus say alike: keyword lines of the input deck, parts of recipe.json.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/solver_inputs.h"

namespace frictab::abaqus {

// "*Surface Interaction, name=FRICTAB", "*Friction, <user>, depvar=<depvar>, properties=<n>" and
// its data lines, 8 values each. `user` as the keyword has it: "user", "user=friction"; DEPVAR and
// PROPERTIES are left out where they are 0.
std::string friction_lines(const std::string& user, unsigned depvar,
                           const std::vector<SolverInput>& inputs);

// Where each state comes from; each property with unit and what stands in for it.
nlohmann::ordered_json recipe_arguments(const std::vector<SolverInput>& inputs);
nlohmann::ordered_json recipe_properties(const std::vector<SolverInput>& inputs);

} // namespace frictab::abaqus
