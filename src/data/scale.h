// Usual values of measurements on rigs and in processes, and the units in which they are written.
// This table serves the checks of a whole campaign (rows of the table of data/plausibility.h), the
// comparison of its tests with each other, and questions about missing units.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// Other units in which rigs write a quantity whose unit here is `unit`, the most likely first.
std::vector<const char*> other_units(const std::string& unit);

// Unit at the end of a column's name if it has the dimension of `wanted`, else empty: "Force_kN",
// "v_mm_s". A single letter before N is a symbol: "F_N" is the normal force.
std::string unit_in_name(const std::string& name, const std::string& wanted);

// Checks for normal stresses far below or above the flow stress of the workpiece. Far below is an
// error only if the unit of the stress was not given and another one makes it usual: a rig of low
// pressure may give a flow stress as well.
Implausible normal_to_flow(const Dataset& data);
Implausible sliding_speed(const Dataset& data);
Implausible temperature(const Dataset& data);  // outside the range of rigs, or in kelvin
Implausible elapsed_time(const Dataset& data); // of a test, and between its rows
Implausible sliding_path(const Dataset& data);

// Finds tests (with several files: all tests of some files) that differ from the others by a factor
// between two units, or by the offset of kelvin, and would be among them in the other unit. It is
// an error if the factor cannot be design: 1,000 and more in a stress, a force or a quantity that
// is equal in all tests (the area, path over speed and time, approximately the coefficient);
// kelvin. Otherwise it is only reported. Nothing is reported if the others span as much, or if
// steps between levels do.
Implausible mixed_units(std::span<const Dataset* const> parts);

// Classifies a quantity without a given unit:
//   * a note if the values are usual as read and in no other unit of rigs, or if the unit cancels;
//   * a question with the values in the other units if they are usual in several;
//   * a question before all others if they are usual only in another unit, or their name ends with
//     another one.
// Sets data.unit_questions.
void ask_for_units(Dataset& data);

} // namespace frictab::data
