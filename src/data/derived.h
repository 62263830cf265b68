// Quantities computed along each experiment from its own columns: histories that an effect may use.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// Rule by which a contact point of a simulation continues a history from one increment to the next.
struct Continuation {
  enum Rule {
    none,     // belongs to the experiment: a simulation has no equivalent
    per_slip, // integral over the slip
    per_time, // integral over the time under pressure
    dwell,    // time at a pressure of at least half of its peak
    mean,     // over the time under pressure
    peak,
    last,       // the value at the end of the last increment
    ratio,      // the value over its peak
    since_peak, // slip since the value was last within 5 % of its peak
    // 1 while it rises, 0 while it falls: it turns 5 % from its last extreme
    direction,
    rise,   // above the value at the start of contact
    lag,    // above the mean so far
    recent, // mean over the last increments, with smaller weights for older ones
    growth, // the value over that at the start of contact
    aging,  // state variables of rate-and-state friction (SlipState)
    slipping
  };
  enum Of { one, pressure, speed, temperature, area, tau, power, flash };
  Rule rule = none;
  Of of = one;
  bool always = false; // routines with state variables store it for every law
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

// A pressure within this share of its peak counts as the peak, because measured pressures always
// fluctuate.
inline constexpr double at_peak = 0.95;

// The state variable theta of rate-and-state friction, in s. After long sliding at speed v it is
// D/v. Its name contains the slip distance D, as a number or as a parameter of a law:
//   aging_state_over_0p0125mm  d theta/dt = 1 - v theta/D               (Dieterich 1979)
//   slip_state_over_D_c        d theta/dt = -(v theta/D) ln(v theta/D)  (Ruina 1983)
// Each experiment starts as after long sliding at the speed of its first sliding row (faster than
// slowest_speed); rows at rest before it have the theta of slowest_speed and do not age. Between
// two rows the speed is the mean of both, for which both equations have closed solutions.
struct SlipState {
  Continuation::Rule rule = Continuation::aging;
  std::string parameter; // "D_c"; empty if D is a number
  double distance_mm = std::numeric_limits<double>::quiet_NaN();
};
std::optional<SlipState> slip_state(std::string_view name);
// Prefixes of their names.
const std::vector<std::pair<std::string, Continuation::Rule>>& slip_states();
// Name for a distance rounded to 4 digits; the second function reads the distance from a name.
std::string slip_state_name(Continuation::Rule rule, double distance_mm);
// Lower limit of sliding speeds in mm/s, because ln(D/v) is infinite at rest.
inline constexpr double slowest_speed = 1e-9;

std::span<const DerivedQuantity>
derived_quantities(); // without slip states, which are unlimited in number
const DerivedQuantity* find_derived(std::string_view name); // nullptr if there is none

// One value per row; integrals by the trapezoidal rule, starting at 0 in every experiment. `tau` is
// the model's shear stress per row (unused by most). The data must have the columns in `needs`. For
// condensed data, returns the block means of the histories derived row by row; histories of tau and
// the states of rate-and-state friction are derived along the means.
std::vector<double> derive(const DerivedQuantity& quantity, const Dataset& data,
                           std::span<const double> tau);

} // namespace frictab::data
