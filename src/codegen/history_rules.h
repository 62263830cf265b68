// The rules by which a routine updates histories (the table in histories.h), each with its Fortran.
#pragma once

#include <string>

#include "data/derived.h"

namespace frictab::codegen {

// Statements, one per line. They may contain @{x} (the law's input), @{h} and @{h1} (the state
// variable before and after the increment), @{time} (the state variable of the time over which
// means are taken), @{increments} (over which the speed is smoothed), @{argument} (p, v, t or a,
// which the rule follows), @{q} (its value in the solver's unit), @{dy} (the derivative of tau_R by
// x), and the conversions from the solver's units @{convert} (of x), @{from_stress}, @{from_speed}
// and @{from_length} (of a speed: to mm per unit of the solver's time); @{slowest} (speed) and
// @{distance} in mm for a state of rate-and-state friction.
struct HistoryRule {
  // Sets @{x} from @{h} and the present pressure p, speed v, temperature t and area a.
  std::string now = {};
  // Sets @{h1}; may also use the peak pmax, tau, slip ds and time dt.
  std::string next = {};
  std::string slope = {}; // adds the derivatives of x by p, v and t to dp, dv and dt

  std::string meaning = {};
  std::string unit = {}; // canonical unit of h; empty: that of x
  bool grows = true;     // as in HistoryState
};

// Throws std::logic_error for the rule `none`.
HistoryRule history_rule(const data::Continuation& how);

// A quantity that a rule may follow.
struct Followed {
  const char* state; // canonical name; empty: not an input of any law
  const char* unit;
  const char* name;     // for messages and comments
  const char* argument; // argument of the Fortran routines
};
const Followed& followed(data::Continuation::Of of);

} // namespace frictab::codegen
