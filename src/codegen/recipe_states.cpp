// The states and properties of a routine in recipe.json.
#include "codegen/recipe_states.h"

#include <nlohmann/json.hpp>

namespace frictab::codegen {

using json = nlohmann::ordered_json;

json recipe_states(const std::vector<SolverInput>& inputs) {
  json out = json::array();
  for (const SolverInput& input : inputs) {
    json one = {{"quantity", input.argument.name},
                {"unit", input.argument.solver.name},
                {"meaning", input.argument.meaning},
                {"source", input.text}};
    if (input.source == Source::constant && input.fallback)
      one["constant"] = input.argument.solver.from_canonical(*input.fallback);
    out.push_back(one);
  }
  return out;
}

json recipe_properties(const std::vector<SolverInput>& inputs, const FurtherProperties& further) {
  json out = json::array();
  for (const SolverInput& input : inputs) {
    if (!input.property) continue;
    json one = {{"number", input.property},
                {"quantity", input.argument.name},
                {"unit", input.argument.solver.name},
                {"meaning", input.argument.meaning},
                {"used_when", input.without.empty() ? "always" : input.without},
                {"where_absent", nullptr}};
    if (input.fallback) one["where_absent"] = input.argument.solver.from_canonical(*input.fallback);
    out.push_back(one);
  }
  for (const FurtherProperty& property : further)
    out.push_back({{"number", property.number},
                   {"quantity", property.quantity},
                   {"unit", property.unit},
                   {"meaning", property.meaning},
                   {"used_when", "always"},
                   {"where_absent", property.where_absent}});
  return out;
}

} // namespace frictab::codegen
