// The units that a test asks a routine in.
#pragma once

#include <string>
#include <vector>

#include "codegen/solver_units.h"

namespace frictab::test {

// One of each canonical unit, in the units of an analysis.
struct SolverScale {
  explicit SolverScale(const codegen::SolverUnits& of) : units(of) {}

  codegen::SolverUnits units;
  std::string name = units.text();
  double stress = one("MPa"), length = one("mm"), time = one("s"), speed = one("mm/s");
  double temperature(double celsius) const {
    return codegen::solver_unit("degC", units).from_canonical(celsius);
  }

private:
  double one(const char* unit) const { return codegen::solver_unit(unit, units).from_canonical(1); }
};

// Every system once; the first two have degC, the next two K, and so on.
inline std::vector<SolverScale> every_system() {
  std::vector<SolverScale> all;
  for (const std::string& system : codegen::unit_system_names())
    all.emplace_back(codegen::SolverUnits(system, all.size() % 4 < 2 ? "degC" : "K"));
  return all;
}

// Every system with every unit of temperature.
inline std::vector<SolverScale> all_units() {
  std::vector<SolverScale> all;
  for (const std::string& system : codegen::unit_system_names())
    for (const std::string& temperature : codegen::temperature_units())
      all.emplace_back(codegen::SolverUnits(system, temperature));
  return all;
}

} // namespace frictab::test
