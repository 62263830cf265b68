// State variables that the routines for explicit solvers keep alike, and their account along a
// driven path: 1 slip, 2 friction work per area, 3 peak pressure, 4 increments outside the range, 5
// and 6 the parts of 1 and 2 lost to rounding in the solver's precision, further histories
// (codegen/histories.h), the parts of these lost to rounding, and last, for output, the frictional
// shear stress and its share of the pressure. With fewer state variables the last are not kept.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "codegen/driven_path.h"

namespace frictab::codegen {

// Number of those before the histories, and of those for output.
inline constexpr std::size_t explicit_states = 6, shown_states = 2;
std::size_t explicit_state_count(const std::vector<SolverInput>& inputs);

struct StateVariable {
  std::string name, unit, meaning;
};

// Words of a solver for its state variables.
struct ExplicitWords {
  std::string slip; // "accumulated slip under pressure"
  std::string step; // "increment"
  std::string mu;   // "that over the pressure"
};
std::vector<StateVariable> explicit_state_variables(const std::vector<SolverInput>& inputs,
                                                    const SolverUnits& units,
                                                    const ExplicitWords& words);
// Describes them for the recipe, numbered from 1.
nlohmann::ordered_json state_variables_json(const std::vector<StateVariable>& variables);

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
  // Returns the variables as the routine finds them: 0 where they are not kept.
  ExplicitVariables kept(const ExplicitVariables& variables) const;
  // Fills the states that follow from them, after a motion (mm) on an area (solver's unit).
  void fill(GivenStates& out, const ExplicitVariables& kept, const ContactMemory& memory,
            double motion, double area) const;

  void add(ExplicitVariables& variables, const ExplicitChange& change) const;
  // Continues the histories by that increment; `peak` includes it, `temperature` in degC.
  void advance(ContactMemory& memory, const ExplicitChange& change, double peak, double area,
               double seconds, double temperature) const;
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
