// Kin of tests: those that are intervals of one recording (one specimen, one clock, cut into
// pieces) resemble each other more than others do. They are held out, left out and drawn again
// together, and none is a repeat of another.
#pragma once

#include <cstddef>
#include <vector>

#include "data/dataset.h"
#include "data/options.h"

namespace frictab::data {

inline constexpr const char* interval_column = "interval";   // number in the recording, from 1
inline constexpr const char* recording_column = "recording"; // its name

// Sorts the tests by name (step 2 before step 10), so that nothing depends on how they were filed,
// and finds their recordings, as options.recording says, else where
//   intervals stand between header lines of one file,
//   the files have a column `recording`, or a group of that name in from_name,
//   the clock of one file, or of files with a running number, goes on from test to test.
// Where at least two tests are of one recording, Dataset::recording and the columns `interval` (in
// order of time) and `recording` are set, and told. Files that look like one recording by a smooth
// course of friction alone are asked for in a note. Throws InputError where options.recording names
// no column, or one that varies within a test.
void find_recordings(Dataset& all, const DataOptions& options);

// Dataset::recording by the column `recording`, where it is one that find_recordings has set.
void group_recordings(Dataset& data);

// What is held out, left out or drawn again as a whole: recordings; tests where no two of them are
// of one recording, or all are of the same.
struct Units {
  std::vector<std::size_t> of; // of each test, 0, 1, ... in order of first appearance
  std::size_t count = 0;
};
Units units_of(const Dataset& data);

} // namespace frictab::data
