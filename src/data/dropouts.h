// Rows in which a temperature sensor had dropped out: its reading jumps to a fixed value (0, or the
// end of a pyrometer's range) and back, as no contact does between two rows.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace frictab::data {

// Rows of one test, ascending. A drop-out is a run of one value between two jumps of at least 30 K
// and ten usual steps. The value occurs twice in the test, or is 0. Runs at an end of the test have
// one jump; there the value has to be that of another drop-out. Empty if half of the rows or more
// would be drop-outs, or for values that are not finite.
std::vector<std::size_t> dropouts_in(std::span<const double> temperature_C);

} // namespace frictab::data
