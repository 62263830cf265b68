// Keyword lines of the targets for Abaqus.
#include "deck.h"

#include <fmt/format.h>

namespace frictab::abaqus {

using namespace codegen;

std::string friction_lines(const std::string& user, std::size_t depvar,
                           const std::vector<SolverInput>& inputs) {
  const std::vector<std::string> values = property_values(inputs);
  std::string deck = "*Surface Interaction, name=FRICTAB\n*Friction, " + user;
  if (depvar > 0) deck += fmt::format(", depvar={}", depvar);
  if (!values.empty()) deck += fmt::format(", properties={}", values.size());
  return deck + "\n" + property_deck(values);
}

std::string property_deck(const std::vector<std::string>& values) {
  std::string deck;
  for (std::size_t i = 0; i < values.size(); ++i)
    deck +=
        (i % 8 == 0 ? " " : ", ") + values[i] + (i % 8 == 7 || i + 1 == values.size() ? "\n" : "");
  return deck;
}

} // namespace frictab::abaqus
