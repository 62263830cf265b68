// Columns of the synthetic campaign that play no part in its physics.
#pragma once

#include "twin/twin_draft.h"

namespace frictab::twin {

// Adds order of tests, room climate, film, roughness and tool; with options.more_bystanders also a
// second film reading, vibration, room temperature, dwell, direction and batch. `tests`: number in
// both parts together.
void add_bystanders(const TwinOptions& options, std::size_t tests, TwinDraft& draft);

} // namespace frictab::twin
