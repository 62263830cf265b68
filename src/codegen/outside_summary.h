// One message at the end of an analysis in which contact points were outside the range of the law:
// how often, and the state furthest beyond an end. With the option `outside_summary = "at_exit"` a
// Fortran routine counts them for the whole program (its threads take turns where a point is
// outside, nowhere else) and has the C library's atexit() write the message to the standard output.
// That works in every solver, without an entry of the solver's own that another routine of the user
// may have taken already; a program that is killed says nothing.
#pragma once

#include <string>

#include "codegen/exporter.h"

namespace frictab::codegen {

// "none", "at_exit", "at_exit_windows" (which has other locks).
ExportOption outside_summary_option();

namespace fortran {

// The subroutine ftseen(x) that ftout(x) calls where it is true, and what it needs; empty where the
// request asks for none, the target does not offer it, or nothing can be outside. How far a state
// is beyond an end is measured in lengths of the range, on logarithmic axes of its logarithm.
std::string outside_summary(const Exporter& exporter, const ExportRequest& request);

} // namespace fortran

} // namespace frictab::codegen
