// State variables that the routines for explicit solvers keep alike, in the account of a driven
// path: 1 slip, 2 friction work per area, 3 peak pressure, 4 increments outside the range, 5 and 6
// what the solver's precision rounds off 1 and 2, further histories, what is rounded off these, and
// last the stress and its share of the pressure. With fewer state variables the last are not kept.
#pragma once

#include <string>

#include "codegen/driven_path.h"

namespace frictab::codegen {

// In the solver's units. The sums include what the solver's precision rounds off.
struct ExplicitVariables {
  double slip = 0, work = 0, peak = 0, outside = 0, stress = 0, mu = 0;
};

// Result of an increment in contact, in the solver's units.
struct ExplicitChange {
  double slip = 0, work = 0, pressure = 0, stress = 0;
  bool outside = false;
};

class ExplicitAccount {
public:
  // `states`: number of state variables that the deck gives.
  ExplicitAccount(DrivenPath& path, std::string name, std::size_t states);

  bool keeps(std::size_t number) const { return states_ >= number; }
  bool keeps_histories() const;
  void add(ExplicitVariables& variables, const ExplicitChange& change) const;
  // Compares the state variables `st` that the routine left.
  void compare(const ExplicitVariables& variables, const ContactMemory& memory,
               const double* st) const;

private:
  void compare_one(const double* st, std::size_t number, std::size_t remainder,
                   const std::string& what, const std::string& unit, double expected) const;
  double summed(double value, std::size_t remainder) const;

  DrivenPath& path_;
  std::string name_; // "STATEV"
  std::size_t states_, histories_, all_;
};

} // namespace frictab::codegen
