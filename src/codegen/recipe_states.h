// recipe.json: the sources of the states, for every routine with SolverInputs.
#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/solver_inputs.h"

namespace frictab::codegen {

// Returns one object per state: quantity, unit, meaning, source; `constant` (solver's unit) if the
// source is a constant.
nlohmann::ordered_json recipe_states(const std::vector<SolverInput>& inputs);

// Returns one object per property of the deck: number, quantity, unit, meaning, used_when,
// where_absent.
nlohmann::ordered_json recipe_properties(const std::vector<SolverInput>& inputs,
                                         const FurtherProperties& further = {});

} // namespace frictab::codegen
