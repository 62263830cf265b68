// Memory of a contact point beyond slip, friction work and peak pressure, computed from the
// definitions in codegen/histories.h: the account with which the state variables of a generated
// routine are compared. It shares no text with the routines.
#pragma once

#include <vector>

#include "codegen/solver_inputs.h"
#include "data/derived.h"

namespace frictab::codegen {

// A contact point during one increment, in canonical units.
struct ContactState {
  double pressure = 0;    // MPa
  double speed = 0;       // mm/s
  double temperature = 0; // degC; 0 if no state of the law needs it
  double area = 0;        // mm^2; 0 if the solver gives none
};

// Result of an increment under pressure, in canonical units.
struct ContactChange {
  double peak_pressure = 0; // including this increment
  double stress = 0;        // frictional shear stress
  double slip = 0;
  double time = 0;
};

class ContactMemory {
public:
  explicit ContactMemory(const std::vector<SolverInput>& inputs);

  // Returns the law's state that input number `index` (Source::history) takes from the memory.
  double state(std::size_t index, const ContactState& now) const;
  // Continues every history by one increment under pressure.
  void advance(const ContactState& now, const ContactChange& change);
  // Returns the memory half way between two nodes; one that was never in contact has the present
  // temperature (degC).
  static ContactMemory between(const ContactMemory& a, const ContactMemory& b, double temperature);
  // Returns the state variables in the units of the solver: the `first` ones, then its own in the
  // order of history_states().
  std::vector<double> variables(const SolverUnits& units, std::vector<double> first = {}) const;

private:
  struct History {
    std::size_t input = 0; // index in the inputs
    data::Continuation how = {};
    double smoothed_over = 0;
    double kept = 0; // canonical units; 0 before the first contact
  };

  std::vector<History> histories_; // by the number of the state variable
  double time_ = 0;                // s under pressure
  bool time_of_its_own_ = false;   // a further state variable holds that time
};

} // namespace frictab::codegen
