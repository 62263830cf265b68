// An invented pin-on-disc rig and the habits of its owner: what real files have that a law must not
// learn from. Synthetic, and nothing of it is the twin's.
//
// 16 tests at four loads, three speeds and three temperatures, 80 rows of steady sliding each, with
//   mu = 0.12 (p/50 MPa)^-0.15 (v/20 mm/s)^-0.06 exp(gain of the test + noise that remembers rows)
// The same seed gives the same sliding rows with and without any habit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/run_command.h"

namespace frictab::test {

enum class Habit {
  none,
  raw_channels,       // torque, friction force in percent of the cell, drive power beside the force
  coefficient_beside, // COF recorded beside the forces
  torque,             // the job computes the force from torque and radius
  rest,               // the disc stands while the load is on, before it starts
  reversals,          // back and forth: signed position and force
  offset,             // the same, with a zero of the force cell that was not set
  intervals,          // four tests of one load in a file, a header line before each
  kilonewtons,        // forces in kN, as the header says
  kelvin,             // one file in kelvin that does not say so
  spikes,             // one row with a friction force that no rig measures
  copied_test         // a file that is there under two names
};
std::vector<Habit> habits();
const char* name_of(Habit habit);

// Writes the files and the job "job.toml" of one law (wzl) into `directory`.
void write_rig(const TemporaryDirectory& directory, std::uint64_t seed, Habit habit);

} // namespace frictab::test
