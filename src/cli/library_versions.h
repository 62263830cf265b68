// Versions of the libraries that frictab was built with.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace frictab::cli {

// Names and versions as the libraries give them: of loaded ones the version that runs, of headers
// that of the build. UDUNITS-2 gives none.
std::vector<std::pair<std::string, std::string>> library_versions();

} // namespace frictab::cli
