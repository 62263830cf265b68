// trace.json, and what the summary says of a trace.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trace/trace.h"

namespace frictab {

// Schema frictab/trace/1 of the first trace; further traced laws are its `others`.
std::string trace_json(const std::vector<Trace>& traces, bool synthetic);
// Everything but curves' points and the extended fits, which calibration.json holds.
std::vector<Trace> parse_traces(std::string_view text, const std::string& file);

// For a person with ten seconds.
std::string trace_text(const Trace& trace);
// `frictab trace --power`: what this campaign could have shown, and what would help.
std::string detectable_text(const Trace& trace);

// "humidity_pct", "friction_work (from s_mm)".
std::string lead_name(const Lead& lead);
// What its tests are for, without them.
std::string design_sentence(const Design& design);
// The tests, how many are alike in front; the first row holds the headings.
std::vector<std::vector<std::string>> design_rows(const Design& design);

// "on mu", "on the limit", "added to tau_R".
const char* site_text(ActsOn acts_on);

// "friction_work (from s_mm)", "humidity_pct", "psi x s_mm".
std::string cause_text(const TracedEffect& effect);

} // namespace frictab
