// Quantities computed along each experiment from its own columns: histories an effect may follow.
#pragma once

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
    rise,       // above the value at the start of contact
    lag,        // above the mean so far
    recent,     // mean over the last increments, the older the less
    growth      // the value over that at the start of contact
  };
  enum Of { one, pressure, speed, temperature, area, tau, power, flash };
  Rule rule = none;
  Of of = one;
  bool always = false; // routines with state variables keep it for every law
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

std::span<const DerivedQuantity> derived_quantities();
const DerivedQuantity* find_derived(std::string_view name); // nullptr where there is none

// One value per row; integrals by the trapezoidal rule, starting at 0 in every experiment. `tau` is
// the model's shear stress per row (unused by most). The data must have what `needs` lists.
std::vector<double> derive(const DerivedQuantity& quantity, const Dataset& data,
                           std::span<const double> tau);

} // namespace frictab::data
