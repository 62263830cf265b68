// Protections that a built program has to have, as readelf and its bytes show them.
#pragma once

#include <string>
#include <vector>

namespace frictab::test {

// Returns what the program lacks, in words; none where all is well. Where sanitizers or no
// optimisation forbid the protections of the compiler, only paths to libraries count.
std::vector<std::string> protections_missing_in(const std::string& program);

} // namespace frictab::test
