// Signed forces, speeds and stresses: fits use magnitudes.
//
// A constant sign is a convention. If a test goes both ways and its force changes sign with the
// direction, the zero of the force cell is the mean of the medians of both directions; it is
// subtracted before the magnitude is taken, cycle by cycle (a stroke and the one back) if it drifts
// beyond its error. A
// difference between the directions that grows in proportion to the load over the tests of a
// campaign is friction instead of a zero, and is kept. The recorded column `direction` (+1, -1)
// gives the direction of each row if a campaign has both.
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

// Stores the signed values of a column of which the job takes the magnitude (a slope, a formula
// with abs), under a name that no file has.
void keep_signed(Part& part, const std::string& canonical, std::vector<double> values);
void forget_signed(Part& part);

// Changes the sign of loads that are negative throughout a test: compression is positive.
void turn_loads(Part& part);

// Returns the phases of all rows. Cuts the tests at pauses first if the options say so (5 rows or
// more at rest or without load); a pause belongs to the next test. Replaces speed and friction by
// their magnitudes, adds their `direction`, records findings in data.signs, and recomputes
// tau_R_MPa from forces.
std::vector<Phase> take_signs(Part& part, const ReadRequest& options);

// Cause of the difference between the directions of a campaign's tests.
enum class DirectionsDiffer { nowhere, by_zero, by_friction, cannot_tell };
DirectionsDiffer directions_differ(const Dataset& data);

// True if tests whose force has one sign in both directions show one zero at all loads.
bool hides_zero(const Dataset& data);

// Adds notes on signs for a whole campaign.
void report_signs(Dataset& data, ForceZero said);

// Adds our own column `direction` where only some of these datasets have one: +1 for all sliding.
void add_direction(std::span<Dataset* const> all);

// Keeps `direction` in all of these datasets or in none: in none if it is the same in all rows.
void settle_directions(std::span<Dataset* const> all);

} // namespace frictab::data
