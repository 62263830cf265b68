// Phase of each row of a test, from its load, speed and path. All limits are relative to the test
// itself.
//
//   unloaded:  less than 5 % of the typical load, except for a low level that is held, at which
//              friction over load is the same as under load;
//   rest:      the speed is zero (also throughout), or below 2 % of the typical one with a mean
//              over the run that does not differ significantly from zero, or with less than half
//              of the friction in motion; where the speed is a set one, that of the path, or too
//              coarse, also where the path stands still; where the speed is a set one, unknown or
//              not usable, also where another reading of a speed is next to zero, with less than
//              half of the friction, and in a few rows at an end of the test with less than an
//              eighth of its coefficient under load;
//   turning:   in a test that goes back and forth: below 20 % of its stroke's speed, in the first
//              and last 5 % of its path, and while the force still builds up after the reversal,
//              or falls off where the force alone shows the reversal;
//   closing,   opening: before and after a steady load, while it builds up or falls off:
//              sliding friction like any other, only counted;
//   sliding:   all other rows. A campaign without a speed, or with one too coarse or too noisy,
//              has no rest and no turning.
//
// tests/unit/phases_test.cpp counts right and wrong phases on an invented rig (synthetic).
#pragma once

#include <span>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

const char* phase_name(Phase phase);
// True if rows of this phase are fitted with data.rows = "sliding".
bool is_fitted(Phase phase);

// Rows of one test, in time order; an empty span is unknown. A non-finite value is replaced by the
// one before it.
struct TestSignals {
  std::span<const double> speed;            // signed if the rig gives a sign
  std::span<const double> time;             // used to derive a missing speed from the path
  std::span<const double> load;             // compression positive
  std::span<const double> path;             // a position, or the distance slid
  std::span<const double> friction;         // signed if the rig gives a sign
  std::span<const double> other_speed = {}; // of a recorded column, in any unit
};

// Share of the usual coefficient below which a row under load does not slide.
inline constexpr double no_friction_share = 1.0 / 8;

// Quality of the speed readings.
enum class SpeedReading { usable, none, still, coarse, noisy };

struct TestPhases {
  std::vector<Phase> rows;
  SpeedReading speed = SpeedReading::none;
  bool has_load = false;
  std::size_t still_by_other_speed = 0, still_by_friction = 0; // rows at rest, by their evidence
  // Rows of one direction, in whole strokes; a single stroke if the test has one direction.
  struct Stroke {
    std::size_t begin, end;
    int direction; // +1, -1
  };
  std::vector<Stroke> strokes;
  bool both_directions() const { return strokes.size() > 1; }
};

TestPhases phases_of(const TestSignals& test);

} // namespace frictab::data
