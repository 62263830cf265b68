// Related tests: intervals of one recording (one specimen, one clock, cut into pieces) resemble
// each other more than other tests do. They are held out, left out and resampled together, and do
// not count as repeats of each other.
#pragma once

#include <cstddef>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

inline constexpr const char* interval_column = "interval";   // number in the recording, from 1
inline constexpr const char* recording_column = "recording"; // its name

// Sorts the tests by name (step 2 before step 10), so that nothing depends on how they were filed,
// and finds their recordings as options.recording defines them. Otherwise tests are of one
// recording if
//   intervals are between header lines of one file,
//   the files have a column `recording`, or a group of that name in from_name,
//   the clock of one file, or of files with a running number, continues from test to test.
// If at least two tests are of one recording, sets Dataset::recording and the columns `interval`
// (in order of time) and `recording`, and adds a note. Files that look like one recording only by a
// smooth course of friction lead to a question in a note. Throws InputError if options.recording
// names no column, or one that varies within a test.
void find_recordings(Dataset& all, const ReadRequest& options);

// Sets Dataset::recording from the column `recording`, if find_recordings has set that column.
void group_recordings(Dataset& data);

// Units that are held out, left out or resampled as a whole: recordings; single tests if no two of
// them share a recording, or all share the same one.
struct Units {
  std::vector<std::size_t> of; // of each test, 0, 1, ... in order of first appearance
  std::size_t count = 0;
};
Units units_of(const Dataset& data);

} // namespace frictab::data
