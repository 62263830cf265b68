// Histories that a law takes beyond slip, friction work and peak pressure: a routine keeps state
// variables for them, in the solver's units, where its law takes them and only there.
//
// Calibration computes a history along the rows of an experiment (data/derived.h). A simulation has
// no rows, but increments, so a contact point keeps what continues it, h, and the law's input x
// follows from h and the state now. With the pressure p, the speed v, the temperature T, the slip
// ds and the time dt of an increment under pressure, and q one of p, v and T:
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
// The last two are asked for by the job, "smoothed:n" for the sliding speed and "area_ratio" for
// the surface expansion, of solvers whose table says that they can (SolverGives). What the surface
// had expanded before its first contact in this analysis is not in a/h, and new nodes (remeshing)
// begin again.
//
// Integrals and means end before the present increment, so that the law's stress does not depend
// on itself and no iteration is needed. Peaks include it: its pressure, speed and temperature are
// known. To first order in the increment this is what rows give. Means are over the time under
// pressure, which is a mean over rows where these are evenly spaced in time; in the first increment
// of a contact they are the present value. The first and the highest temperature are kept in K: 0,
// with which a solver begins, then stands for "no contact yet".
#pragma once

#include <span>
#include <string>
#include <vector>

#include "codegen/solver_inputs.h"
#include "core/template.h"

namespace frictab::codegen {

// One state variable.
struct HistoryState {
  std::string name;    // of the state that follows from it: "energy"
  std::string unit;    // the solver's
  std::string meaning; // "contact normal stress times time under pressure"
  bool grows = true;   // a sum from the start: its increments are small against it
};

// Those that these inputs (Source::history) need, in the order of SolverInput::history; behind them
// the time that means are taken over, where no input is it.
std::vector<HistoryState> history_states(const std::vector<SolverInput>& inputs,
                                         std::string_view units);
std::size_t history_count(const std::vector<SolverInput>& inputs);

// Behind them what the solver's precision rounds off each; `before`: state variables in front.
std::vector<HistoryState> with_remainders(std::vector<HistoryState> states, std::size_t before);

// "8 pressure times slip, summed (MPa mm)", the first with that number; `pattern` writes it.
std::vector<std::string> numbered(const std::vector<HistoryState>& states, std::size_t first,
                                  const std::string& pattern = "{}");

// Numbers of those that are 0 K where there was no contact yet: no value to take a mean with.
std::vector<std::size_t> peak_temperatures(const std::vector<SolverInput>& inputs);

// The state variable that holds the area at the first contact, from 1; 0: there is none.
std::size_t first_area(const std::vector<SolverInput>& inputs);

// True for a history that needs a state variable of its own.
bool is_further_history(const std::string& name);
// Numbers of those that hold the temperature at the start of contact in K, 0 where there was none.
std::vector<std::size_t> start_temperatures(const std::vector<SolverInput>& inputs);

// Whether it follows the contact temperature, which the routine then has to know as well.
bool follows_temperature(const std::string& name);

namespace fortran {

// Adds to the values of a source in fixed form: flag has_histories; texts temperature_now ("x(5)",
// or a zero where none follows it), area_now (", area" where one follows it, an argument behind the
// temperature) and histories_text, the units
//   ftpast(h, p, v, t, x): those states x (canonical) from the state variables h before the
//     increment and the present pressure and speed (solver's units) and temperature (degC),
//   ftnext(h, p, v, t, pmax, tau, ds, dt, h1): h1 behind the increment, of slip ds and time dt;
//     pmax is the peak pressure so far, tau the frictional stress,
//   ftlive(h, p, v, t, dy, dp, dv, dt), with `gradient`: adds to the derivatives of tau_R by
//     pressure, speed and temperature (canonical) what histories of the present values add.
// Empty where the law has none. NaN in gives NaN where it is used.
void add_histories(TemplateValues& values, const std::vector<SolverInput>& inputs,
                   std::string_view units, bool gradient);

} // namespace fortran

// For drivers of solvers that give the area: flag has_area and text first_area.
TemplateValues area_of_driver(const ExportRequest&, const std::vector<SolverInput>& inputs);

// The state variables (solver's units) at which a row's histories are what its columns say, on an
// area of 1.
std::vector<double> history_values(const std::vector<SolverInput>& inputs,
                                   std::span<const double* const> columns, std::size_t row);

// Whether a contact point can have these histories: a peak is not below the present value (0 where
// the law does not take it and it is no constant), a mean needs time, a load over its peak a load
// that the law takes, and a load rises or falls.
bool histories_are_representable(const std::vector<SolverInput>& inputs,
                                 std::span<const double* const> columns, std::size_t row);

} // namespace frictab::codegen
