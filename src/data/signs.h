// Forces, speeds and stresses with a sign: what is fitted are magnitudes.
//
// One sign all along is a convention. Where a test goes both ways and its force changes sign with
// the direction, the force cell's zero is the mean of the medians of both directions, cycle by
// cycle (a cycle: a stroke and the one back), which is taken off before the magnitude is. What both
// directions differ by is no zero but friction where it grows in proportion to the load over the
// tests of a campaign: then it stays. Which way a row goes stands in the recorded column
// `direction`
// (+1, -1), where a campaign has both.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "data/options.h"
#include "data/part.h"
#include "data/phases.h"

namespace frictab::data {

inline constexpr const char* direction_column = "direction";
inline constexpr const char* direction_why =
    "which way the row goes, by the sign of speed or friction";

// Beside a column that the job makes a magnitude of (a slope, a formula with abs) its values with
// their sign, under a name that no file has.
void keep_signed(Part& part, const std::string& canonical, std::vector<double> values);
void forget_signed(Part& part);

// Loads that are negative all along in a test: compression is positive.
void turn_loads(Part& part);

// Phases of all rows; magnitudes of speed and friction, their `direction`, what was found in
// data.signs. tau_R_MPa of forces follows them.
std::vector<Phase> take_signs(Part& part, const DataOptions& options);

// What the directions of a campaign's tests differ by.
enum class DirectionsDiffer { nowhere, by_zero, by_friction, cannot_tell };
DirectionsDiffer directions_differ(const Dataset& data);

// Notes of all this for a whole campaign.
void tell_signs(Dataset& data, ForceZero said);

// A column `direction` of our own where only some of these have one: all that slides forward.
void add_direction(std::span<Dataset* const> all);

// `direction` in all of these or in none: in none where it is the same in all rows.
void settle_directions(std::span<Dataset* const> all);

} // namespace frictab::data
