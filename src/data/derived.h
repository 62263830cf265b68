// Quantities computed along each experiment from its own columns: histories an effect may follow.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/dataset.h"

namespace frictab {

// `needs` lists columns; "tau" stands for a model's shear stress. Never derive a history from
// measured tau_R: its noise would leak into the quantity.
struct DerivedQuantity {
  std::string name;
  std::string unit;
  std::string meaning;
  std::vector<std::string> needs;
};

std::span<const DerivedQuantity> derived_quantities();
const DerivedQuantity* find_derived(std::string_view name); // nullptr where there is none

// Histories that generated routines keep as state variables of a contact point; others are
// constants there.
bool is_followed(std::string_view derived);

// One value per row; integrals by the trapezoidal rule, starting at 0 in every experiment. `tau` is
// the model's shear stress per row (unused by most). The data must have what `needs` lists.
std::vector<double> derive(const DerivedQuantity& quantity, const Dataset& data,
                           std::span<const double> tau);

} // namespace frictab
