// recipe.json: where the states come from, as every routine with SolverInputs says it.
#pragma once

#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/solver_inputs.h"

namespace frictab::codegen {

// One object per state: quantity, unit, meaning, source; `constant` (solver's unit) where the
// source is one.
nlohmann::ordered_json recipe_states(const std::vector<SolverInput>& inputs);

// One object per property of the deck: number, quantity, unit, meaning, used_when, where_absent.
nlohmann::ordered_json recipe_properties(const std::vector<SolverInput>& inputs,
                                         const FurtherProperties& further = {});

} // namespace frictab::codegen
