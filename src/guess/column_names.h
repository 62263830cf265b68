// Quantities by the names that rigs and offices give their columns.
#pragma once

#include <string>
#include <vector>

#include "guess/guess.h"

namespace frictab::guess {

// Assigns each quantity to the column with the greatest likeness, the first one of equals.
void name_columns(std::vector<Column>& columns);

// The factor of a recorded speed of rotation in a formula for mm/s at a radius in mm: "2*pi/60" for
// rpm; empty for other columns.
std::string turn_factor(const Column& column);

// True for kg: a load in it is the weight of a mass.
bool is_in_mass(const Column& column);

// True for a wanted value, as opposed to a measured one: "Speed setpoint".
bool names_wanted(const Column& column);

} // namespace frictab::guess
