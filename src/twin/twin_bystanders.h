// Columns of the synthetic campaign that have no part in its physics.
#pragma once

#include "twin/twin_draft.h"

namespace frictab::twin {

// Order of tests, room climate, film, roughness and tool; with options.more_bystanders also a
// second film reading, vibration, room temperature, dwell, direction and batch. `tests` counts both
// parts.
void add_bystanders(const TwinOptions& options, std::size_t tests, TwinDraft& draft);

} // namespace frictab::twin
