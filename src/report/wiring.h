// Wiring of a generated routine into its solver, from its recipe.json.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"

namespace frictab::report {

struct WiringLine {
  std::string quantity, unit, source;
};

struct Wiring {
  std::string path, title, model, entry, units;
  std::vector<std::string> files, compile;
  std::string input_deck; // empty where the solver's deck needs no lines
  std::vector<WiringLine> arguments;
};

// Throws InputError where the text is not a recipe.
Wiring wiring_of(const Recipe& recipe);

} // namespace frictab::report
