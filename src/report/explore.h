// explore.html: laws, tests and states on one offline page that can be asked.
#pragma once

#include <string>

#include "report/report.h"

namespace frictab::report {

// Writes one self-contained page: curves of the laws that the reader picks over one state, a map
// over two, sliders for the others, the tests with their states and residuals. Laws are evaluated
// in the page by their own formulas (codegen/javascript.h).
std::string explore_html(const ReportInput& input);

} // namespace frictab::report
