// Keyword lines and recipe parts of the targets for Abaqus.
#include "deck.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace frictab::abaqus {

using json = nlohmann::ordered_json;

std::string friction_lines(const std::string& user, unsigned depvar,
                           const std::vector<SolverInput>& inputs) {
  const std::vector<std::string> values = property_values(inputs);
  std::string deck = "*Surface Interaction, name=FRICTAB\n*Friction, " + user;
  if (depvar > 0) deck += fmt::format(", depvar={}", depvar);
  if (!values.empty()) deck += fmt::format(", properties={}", values.size());
  deck += "\n";
  for (std::size_t i = 0; i < values.size(); ++i)
    deck +=
        (i % 8 == 0 ? " " : ", ") + values[i] + (i % 8 == 7 || i + 1 == values.size() ? "\n" : "");
  return deck;
}

json recipe_arguments(const std::vector<SolverInput>& inputs) {
  json out = json::array();
  for (const SolverInput& input : inputs)
    out.push_back({{"quantity", input.argument.name},
                   {"unit", input.argument.solver.name},
                   {"meaning", input.argument.meaning},
                   {"source", input.text}});
  return out;
}

json recipe_properties(const std::vector<SolverInput>& inputs) {
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
  return out;
}

} // namespace frictab::abaqus
