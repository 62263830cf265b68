// Keyword lines of the input deck that all targets for Abaqus share.
#pragma once

#include <string>
#include <vector>

#include "codegen/deck.h"
#include "codegen/solver_inputs.h"

namespace frictab::abaqus {

// Returns a deck with "*Surface Interaction, name=FRICTAB", "*Friction, <user>, depvar=<depvar>,
// properties=<n>" and its data lines, 8 values each, those of `inputs` before `further`. `user` as
// in the keyword: "user", "user=friction". DEPVAR and PROPERTIES are left out if they are 0.
codegen::Deck friction_deck(const std::string& user, std::size_t depvar,
                            const std::vector<codegen::SolverInput>& inputs,
                            const codegen::FurtherProperties& further, const std::string& of_model);

inline const std::string general_contact_lines = "*Contact\n*Contact Inclusions, ALL EXTERIOR\n"
                                                 "*Contact Property Assignment\n , , FRICTAB\n";

// Returns the lines that define the field variables of the law, as comments and keywords; empty if
// the law takes none.
std::string field_lines(const std::vector<codegen::SolverInput>& inputs);

// Returns the lines with names of the model for contact pairs of Abaqus/Standard.
std::string standard_lines(const std::vector<codegen::SolverInput>& inputs);

} // namespace frictab::abaqus
