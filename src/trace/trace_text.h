// A trace in words: what the summary on the terminal and the report say of it.
#pragma once

#include <string>
#include <vector>

#include "trace/trace.h"

namespace frictab::trace {

// Verdict, effects, errors before and after, what is left, leads and what was tried.
std::string trace_text(const Trace& trace, bool coefficients = false);
// The same without what is left and tried, and of leads that were not found their names.
std::string trace_brief(const Trace& trace);
// "not confirmed: v_rel_mm_s (p = 0.001, would take 15.0 to about 10.2 MPa)": what was found and is
// not delivered; empty: there is none.
std::string not_confirmed(const Trace& trace);
// Where training tests that were left out would not have been enough: that, without a full stop;
// empty: they were.
std::string shown_by_validation(const Trace& trace);
// What is missing and what adding it gained: one line without its end.
std::string trace_in_short(const Trace& trace);
// `frictab trace --power`: what this campaign could have shown, and what would help.
std::string detectable_text(const Trace& trace);

// "humidity_pct", "friction_work (from s_mm)".
std::string lead_name(const Lead& lead);
// What the proposed tests would show and how probably, without the tests themselves.
std::string design_sentence(const Design& design);
// The tests as rows of a table: how many are alike, then the values. The first row has the
// headings.
std::vector<std::vector<std::string>> design_rows(const Design& design);

// "on mu", "on the limit", "added to tau_R".
const char* site_text(effects::ActsOn acts_on);

// "friction_work (from s_mm)", "humidity_pct", "psi x s_mm".
std::string cause_text(const TracedEffect& effect);

} // namespace frictab::trace
