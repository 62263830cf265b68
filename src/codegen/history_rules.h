// The rules by which a routine continues histories (the table in histories.h), each with the
// Fortran that does it.
#pragma once

#include <string>

#include "data/derived.h"

namespace frictab::codegen {

// Statements, a line each. They may hold @{x} (the law's input), @{h} and @{h1} (the state variable
// before and behind the increment), @{time} (the state variable of the time that means are taken
// over), @{increments} (those that the speed is smoothed over), @{q} (the argument p, v, t or a
// that the rule follows), @{dy} (the derivative of tau_R by x), and the conversions from the
// solver's units @{convert} (of x), @{from_stress} and @{from_speed}; @{slowest} (speed) and
// @{distance} in mm of a state of rate-and-state friction.
struct HistoryRule {
  // sets @{x} by @{h} and the pressure p, speed v, temperature t and area a now
  std::string now = {};
  std::string next = {};  // sets @{h1}; knows the peak pmax, tau, slip ds and time dt as well
  std::string slope = {}; // adds to dp, dv and dt what x changes by p, v and t

  std::string meaning = {};
  std::string unit = {};   // of h, canonical; empty: that of x
  bool times_time = false; // that unit times s
  bool grows = true;       // as in HistoryState
};

// Throws std::logic_error for the rule `none`.
HistoryRule history_rule(const data::Continuation& how);

// A quantity that a rule may follow.
struct Followed {
  const char* state; // canonical name; empty: no law takes it
  const char* unit;
  const char* name;     // for people
  const char* argument; // of the Fortran routines
};
const Followed& followed(data::Continuation::Of of);

} // namespace frictab::codegen
