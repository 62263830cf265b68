// One message at the end of an analysis in which contact points were outside the range of the law:
// how often, and the state furthest beyond an end. With the option `outside_summary = "at_exit"` a
// Fortran routine counts them for the whole program (its threads take turns only if a point is
// outside) and has the C library's atexit() write the message to the standard output. This works in
// every solver, without an entry of the solver's own that another routine of the user may already
// use. A program that is killed prints nothing.
#pragma once

#include <string>

#include "codegen/exporter.h"

namespace frictab::codegen {

// Option with values "none", "at_exit", "at_exit_windows" (which uses Windows locks).
ExportOption outside_summary_option();

namespace fortran {

// Returns the subroutine ftseen(x), which ftout(x) calls if it is true, with everything it needs.
// Empty if the request does not ask for it, the target does not offer it, or nothing can be
// outside. The distance of a state beyond an end is measured in lengths of the range, on
// logarithmic axes in the logarithm.
std::string outside_summary(const Exporter& exporter, const ExportRequest& request);

} // namespace fortran

} // namespace frictab::codegen
