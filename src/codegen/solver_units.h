// The units of a solver. frictab has stress in MPa, length in mm, speed in mm/s; an analysis is in
// mm-t-s or in m-kg-s. Every number that enters or leaves a routine is converted here.
#pragma once

#include <string>
#include <string_view>

namespace frictab::codegen {

// A unit of the solver: canonical = value * times / over (one of the two is 1, so that every
// conversion is one correctly rounded operation).
struct SolverUnit {
  std::string name;
  double times = 1;
  double over = 1;
  double to_canonical(double value) const { return value * times / over; }
  double from_canonical(double value) const { return value / times * over; }
  bool same() const { return times == 1 && over == 1; }
};

// Returns the solver's unit. `units` is mm-t-s or m-kg-s; throws InputError otherwise. Units
// without a counterpart (degC, 1, a traced column's) are unchanged.
SolverUnit solver_unit(std::string_view canonical_unit, std::string_view units);

} // namespace frictab::codegen
