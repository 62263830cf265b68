// What the rows of a test show of friction, from its load, speed and path. All limits are shares of
// what the test itself shows.
//
//   unloaded:  less than 5 % of the typical load, unless what rubs there rubs as it does under load
//              (a low level that is held);
//   rest:      the speed is zero (also all along), or below 2 % of the typical one with a mean over
//              the run that cannot be told from zero;
//   turning:   of a test that goes back and forth: below 20 % of its stroke's speed, in the first
//              and last 5 % of its path, and while the force still builds up the other way;
//   closing,   opening: before and after a load that is steady, where it builds up or falls away:
//              sliding friction like any other, counted only;
//   sliding:   all else. A campaign without a speed, or with one too coarse or too noisy to say,
//              has no rest and no turning.
//
// tests/unit/phases_test.cpp counts right and wrong calls on an invented rig (synthetic).
#pragma once

#include <span>
#include <vector>

#include "data/dataset.h"

namespace frictab::data {

const char* phase_name(Phase phase);
// Whether rows of this phase are fitted where data.rows = "sliding".
bool is_fitted(Phase phase);

// Rows of one test, in time order; an empty span is not known. What is not finite counts as what
// stands before it.
struct TestSignals {
  std::span<const double> speed;    // with its sign where the rig gives one
  std::span<const double> time;     // gives the speed of a path where there is no speed
  std::span<const double> load;     // compression positive
  std::span<const double> path;     // a position, or the distance slid
  std::span<const double> friction; // with its sign where the rig gives one
};

// What a reading of speed is good for.
enum class SpeedReading { usable, none, still, coarse, noisy };

struct TestPhases {
  std::vector<Phase> rows;
  SpeedReading speed = SpeedReading::none;
  bool has_load = false;
  // Rows of one direction, whole strokes; one where the test has one direction.
  struct Stroke {
    std::size_t begin, end;
    int direction; // +1, -1
  };
  std::vector<Stroke> strokes;
  bool both_directions() const { return strokes.size() > 1; }
};

TestPhases phases_of(const TestSignals& test);

} // namespace frictab::data
