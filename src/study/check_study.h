// All results of a study against the hashes that were stored with them.
#pragma once

#include <string>
#include <vector>

#include "study/plan.h"

namespace frictab::study {

// Returns a line for each file that is not as it was written, "campaign b: results/KEY/trace.json
// was changed".
std::vector<std::string> check_study(const Plan& plan, const Found& found);

} // namespace frictab::study
