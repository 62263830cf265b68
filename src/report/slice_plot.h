// A slice of a table as a figure of its own.
#pragma once

#include <string>

#include "table/slice.h"

namespace frictab::report {

// Draws one line of tau_R; for two states, lines along the first one at up to seven values of the
// second.
std::string slice_svg(const table::Slice& slice);

} // namespace frictab::report
