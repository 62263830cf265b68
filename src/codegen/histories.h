// Histories that a law takes in addition to slip, friction work and peak pressure. A routine keeps
// state variables for them, in the solver's units, only if its law takes them.
//
// Calibration computes a history along the rows of an experiment (data/derived.h). A simulation has
// increments instead of rows, so a contact point keeps a state variable h, and the law's input x
// follows from h and the present state. With the pressure p, the speed v, the temperature T, the
// slip ds and the time dt of an increment under pressure, and q one of p, v and T:
//
//   integral over the slip     h' = h + p ds                      x = h
//   time under pressure        h' = h + dt                        x = h
//   dwell                      h' = h + dt where p >= peak/2      x = h
//   slip since the peak        h' = h + ds; 0 at p >= 0.95 peak   x = h
//   mean                       h' = h + q dt                      x = h/time
//   lag                        h' = h + T dt                      x = T - h/time
//   peak                       h' = max(h, q)                     x = max(h, q)
//   load over its peak         h' = max(h, p)                     x = p/max(h, p)
//   direction of load          h' = highest p while it rises,     x = 1 or 0 by the sign of h'
//                                   minus the lowest while it falls
//   rise                       h' = T of the first increment      x = T - h
//   friction power, flash      h' = tau v, tau sqrt(v)            x = h
//   smoothed speed             h' = h + (v - h)/n                 x = h + (v - h)/n
//   growth of the area a       h' = a of the first increment      x = a/h
//
// The job requests the last two, "smoothed:n" for the sliding speed and "area_ratio" for the
// surface expansion, from solvers whose table offers them (SolverGives). a/h leaves out any
// expansion of the surface before its first contact in this analysis, and starts over at new nodes
// (remeshing).
//
// Integrals and means end before the present increment, so that the law's stress does not depend on
// itself and no iteration is needed. Peaks include it, because its pressure, speed and temperature
// are known. To first order in the increment this equals the result from rows. Means are over the
// time under pressure, which equals a mean over rows that are evenly spaced in time; in the first
// increment of a contact they are the present value. The first and the highest temperature are kept
// in K, so that 0, the solver's initial value, means "no contact yet".
#pragma once

#include <span>
#include <string>
#include <vector>

#include "codegen/solver_inputs.h"
#include "core/template.h"
#include "data/derived.h"

namespace frictab::codegen {

struct HistoryState {
  std::string name;    // name of the state computed from it: "energy"
  std::string unit;    // in the solver's system
  std::string meaning; // "contact normal stress times time under pressure"
  bool grows = true;   // a sum from the start: its increments are small relative to it
};

// Returns the rule by which an input (Source::history) goes on.
data::Continuation continuation(const SolverInput& input);

// Returns the state variables that these inputs (Source::history) need, in the order of
// SolverInput::history, followed by the time over which means are taken, unless an input is that
// time.
std::vector<HistoryState> history_states(const std::vector<SolverInput>& inputs,
                                         const SolverUnits& units);
std::size_t history_count(const std::vector<SolverInput>& inputs);

// Appends, for each, the part lost to rounding in the solver's precision; `before`: number of
// preceding state variables.
std::vector<HistoryState> with_remainders(std::vector<HistoryState> states, std::size_t before);

// Returns "8 pressure times slip, summed (MPa mm)", the first with number `first`; `pattern`
// formats the number.
std::vector<std::string> numbered(const std::vector<HistoryState>& states, std::size_t first,
                                  const std::string& pattern = "{}");

// Returns the numbers of state variables that are 0 K before the first contact, which a mean must
// not include.
std::vector<std::size_t> peak_temperatures(const std::vector<SolverInput>& inputs);

// Returns the number of the state variable with the area at the first contact, from 1; 0: none.
std::size_t first_area(const std::vector<SolverInput>& inputs);

// True for a history that needs its own state variable.
bool is_further_history(const std::string& name);
// Returns the numbers of the state variables with the temperature at the start of contact in K, 0
// before it.
std::vector<std::size_t> start_temperatures(const std::vector<SolverInput>& inputs);

// True if the history follows the contact temperature, which the routine then needs as well.
bool follows_temperature(const std::string& name);

namespace fortran {

// Adds values for a source in fixed form: flag has_histories; texts temperature_now ("x(5)", or a
// zero if no history follows the temperature), area_now (", area" if a history follows it, as an
// argument after the temperature) and histories_text, the units
//   ftpast(h, p, v, t, x): sets these states x (canonical) from the state variables h before the
//   increment and the present pressure and speed (solver's units) and temperature (degC),
//   ftnext(h, p, v, t, pmax, tau, ds, dt, h1): sets h1 after the increment, with slip ds and time
//   dt; pmax is the peak pressure so far, tau the frictional stress,
//   ftlive(h, p, v, t, dy, dp, dv, dt), with `gradient`: adds the contributions of histories of the
//   present values to the derivatives of tau_R by pressure, speed and temperature (canonical).
// The texts are empty if the law has no histories. NaN gives NaN wherever it is used.
void add_histories(TemplateValues& values, const std::vector<SolverInput>& inputs,
                   const SolverUnits& units, bool gradient);

} // namespace fortran

// Returns values for drivers of solvers that give the area: flag has_area and text first_area.
TemplateValues area_of_driver(const ExportRequest&, const std::vector<SolverInput>& inputs);

// Returns the state variables (solver's units) at which the histories equal a row's columns, on an
// area of 1.
std::vector<double> history_values(const std::vector<SolverInput>& inputs,
                                   std::span<const double* const> columns, std::size_t row);

// True if a contact point can have these histories: a peak is not below the present value (taken as
// 0 if the law does not take it and it has no constant), a mean needs time, a load over its peak
// needs a load as input, and a load rises or falls.
bool histories_are_representable(const std::vector<SolverInput>& inputs,
                                 std::span<const double* const> columns, std::size_t row);

} // namespace frictab::codegen
