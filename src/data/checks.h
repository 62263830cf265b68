// What cannot be in a file, told once per cause with its count.
#pragma once

#include "data/options.h"
#include "data/part.h"

namespace frictab::data {

// Cells that are no numbers, in the rows that are kept; what was to be computed from such a cell
// follows them.
void tell_cells(Part& part);

// A contact normal stress: a column that is mapped and absent has had its fault already.
void check_needed(Part& part, const DataOptions& options);

// Quantities below their lowest value, and rows without load where eq. 1 divides by it.
void check_values(Part& part);

// Values that could not be computed though every cell of their row is a number; a measured stress
// where rows need none apart.
void check_computed(Part& part, const DataOptions& options);

// Time that goes back; tests of one row among others, where they are measured.
void check_experiments(Part& part, const DataOptions& options);

} // namespace frictab::data
