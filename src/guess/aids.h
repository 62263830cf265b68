// Columns and conditions that a formula takes along with quantities: lengths of the bodies,
// strokes, frequencies, factors of calibration.
#pragma once

#include <string>

#include "guess/guess.h"

namespace frictab::guess {

enum class Aid {
  track_radius,
  track_diameter, // of a track or a ring
  pin_diameter,   // of a flat body that presses
  ball_radius,
  ball_diameter,
  stroke,
  frequency,
  position,    // of a sled, row by row
  voltage,     // of the cell that measures friction
  calibration, // force per voltage
};

// True by the name and the unit of a column of numbers without another meaning, whose name formulas
// can take. A path that slides is a position too.
bool is_aid(const Column& column, Aid aid);

// Factor from the unit of the column, given in the file or at the end of its name, to `unit`; 1
// without one.
double factor_to(const Column& column, const std::string& unit);

// The column in a formula, converted to `unit` and divided: "Track_radius", "10*Track_radius",
// "Ring_diameter/2". Without a unit in the file it is taken to be in this one.
std::string term_of(const Column& column, const std::string& unit, double divided_by = 1);

} // namespace frictab::guess
