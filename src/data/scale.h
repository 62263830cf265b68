// How large what rigs and processes measure is, and in which units they write it. From this one
// table: checks of a whole campaign (rows of the table of data/plausibility.h), the comparison of
// its tests with each other, and questions about units that nobody gave.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

// In which rigs write what is in `unit` here, the likeliest first.
std::vector<const char*> other_units(const std::string& unit);

// The unit that a column's name ends with where it measures the same as `wanted`, else empty:
// "Force_kN", "v_mm_s". One letter in front of N is a symbol: "F_N" is the normal force.
std::string unit_in_name(const std::string& name, const std::string& wanted);

// Normal stresses far below or above the flow stress of the workpiece. Far below is an error only
// where nobody gave the unit of the stress and another one makes it usual: a rig of low pressure
// may name a flow stress as well.
Implausible normal_to_flow(const Dataset& data);
Implausible sliding_speed(const Dataset& data);
Implausible temperature(const Dataset& data);  // outside what rigs bear, or in kelvin
Implausible elapsed_time(const Dataset& data); // of a test, and between its rows
Implausible sliding_path(const Dataset& data);

// Tests (where there are several files: all tests of some files) that stand apart from the others
// by a factor between two units, or by that of kelvin, and would be among them in the other unit.
// An error where that factor cannot be design: 1,000 and more in a stress, a force or what is the
// same in all tests (the area, path over speed and time, roughly the coefficient); kelvin. Else
// told. Nothing is claimed where the others span as much, or where steps between levels do.
Implausible mixed_units(std::span<const Dataset* const> parts);

// A unit that nobody gave is
// * a note where the values are usual as read and in no other unit of rigs, or where it cancels;
// * a question with what the other units give where they are usual in several;
// * a question in front of all others where they are usual in another unit only, or their name
//   ends with another one.
// Sets data.unit_questions.
void ask_for_units(Dataset& data);

} // namespace frictab::data
