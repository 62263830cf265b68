// Quantities computed along each experiment from its own columns: histories an effect may follow.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// How a contact point of a simulation continues a history from one increment to the next.
struct Continuation {
  enum Rule {
    none,     // belongs to the experiment: a simulation has no such thing
    per_slip, // integral over the slip
    per_time, // integral over the time under pressure
    dwell,    // time at no less than half of the peak pressure
    mean,     // over the time under pressure
    peak,
    last,       // the value at the end of the last increment
    ratio,      // the value over its peak
    since_peak, // slip since it was last within 5 % of its peak
    direction,  // 1 while it rises, 0 while it falls: it turns 5 % from its last extreme
    rise,       // above the value at the start of contact
    lag,        // above the mean so far
    recent,     // mean over the last increments, the older the less
    growth,     // the value over that at the start of contact
    aging,      // state variables of rate-and-state friction (SlipState)
    slipping
  };
  enum Of { one, pressure, speed, temperature, area, tau, power, flash };
  Rule rule = none;
  Of of = one;
  bool always = false; // routines with state variables keep it for every law
  double distance_mm = std::numeric_limits<double>::quiet_NaN(); // aging, slipping: D
};

// `needs` lists columns; "tau" stands for a model's shear stress. Never derive a history from
// measured tau_R: its noise would leak into the quantity.
struct DerivedQuantity {
  std::string name;
  std::string unit;
  std::string meaning;
  std::vector<std::string> needs;
  Continuation continuation;
};

// Within this share of its peak a pressure is at its peak: measured ones are never still.
inline constexpr double at_peak = 0.95;

// The state variable theta of rate-and-state friction, in s: where the sliding speed has long been
// v it is D/v. D, a slip distance, stands in its name, as a number or as a parameter of a law:
//   aging_state_over_0p0125mm  d theta/dt = 1 - v theta/D               (Dieterich 1979)
//   slip_state_over_D_c        d theta/dt = -(v theta/D) ln(v theta/D)  (Ruina 1983)
// Each experiment starts as if it had long slid at the speed of its first row that slides (faster
// than slowest_speed); what rested before it slid has that of slowest_speed, and does not age.
// Between rows the speed is the mean of theirs, for which both equations have closed solutions.
struct SlipState {
  Continuation::Rule rule = Continuation::aging;
  std::string parameter; // "D_c"; empty where D is a number
  double distance_mm = std::numeric_limits<double>::quiet_NaN();
};
std::optional<SlipState> slip_state(std::string_view name);
// What their names begin with.
const std::vector<std::pair<std::string, Continuation::Rule>>& slip_states();
// Of a distance that is rounded to 4 digits, and the distance that this name holds.
std::string slip_state_name(Continuation::Rule rule, double distance_mm);
// Sliding speeds are taken as no slower, in mm/s: at rest ln(D/v) has no end.
inline constexpr double slowest_speed = 1e-9;

std::span<const DerivedQuantity>
derived_quantities(); // without slip states, of which there is no end
const DerivedQuantity* find_derived(std::string_view name); // nullptr where there is none

// One value per row; integrals by the trapezoidal rule, starting at 0 in every experiment. `tau` is
// the model's shear stress per row (unused by most). The data must have what `needs` lists. Of
// condensed data the means of what was derived row by row; what follows tau, and the states of
// rate-and-state friction, is derived along the means.
std::vector<double> derive(const DerivedQuantity& quantity, const Dataset& data,
                           std::span<const double> tau);

} // namespace frictab::data
