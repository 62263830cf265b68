// A trace in words, for the terminal summary and the report.
#pragma once

#include <string>
#include <vector>

#include "trace/trace.h"

namespace frictab::trace {

// Formats verdict, effects, errors before and after, remaining structure, leads and the extent of
// the search.
std::string trace_text(const Trace& trace, bool coefficients = false);
// The same without remaining structure and extent; leads that were not found appear by name only.
std::string trace_brief(const Trace& trace);
// Lists findings that are not delivered: "not confirmed: v_rel_mm_s (p = 0.001, would take 15.0 to
// about 10.2 MPa)"; empty: none.
std::string not_confirmed(const Trace& trace);
// Remark, without a full stop, that the validation tests were needed because left-out training
// tests were inconclusive; empty: they were conclusive.
std::string shown_by_validation(const Trace& trace);
// Summary in one line without a line end: the missing effects and the gain of adding them.
std::string trace_in_short(const Trace& trace);
// Report of `frictab trace --power`: what this campaign could have detected, and what would improve
// that.
std::string detectable_text(const Trace& trace);

// "humidity_pct", "friction_work (from s_mm)".
std::string lead_name(const Lead& lead);
// Result and probability of the proposed tests, without the tests themselves.
std::string design_sentence(const Design& design);
// The tests as rows of a table: number of equal tests, then the values. The first row has the
// headings.
std::vector<std::vector<std::string>> design_rows(const Design& design);

// "on mu", "on the limit", "added to tau_R".
const char* site_text(effects::ActsOn acts_on);

// "friction_work (from s_mm)", "humidity_pct", "psi x s_mm".
std::string cause_text(const TracedEffect& effect);

} // namespace frictab::trace
