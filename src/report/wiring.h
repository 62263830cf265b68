// How a generated routine is wired into its solver, as its recipe.json says.
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
  std::string input_deck; // empty where the solver's deck says nothing
  std::vector<WiringLine> arguments;
};

// Throws InputError where the text is no recipe.
Wiring wiring_of(const Recipe& recipe);

} // namespace frictab::report
