// A trace in words and tables.
#pragma once

#include <string>

#include "trace/trace.h"
#include "words/document.h"

namespace frictab::words {

// Verdict, effects, errors before and after. full: also the remaining structure, each lead and the
// extent of the search; verbose: also the coefficients of effects. An effect is a section of its
// own, in the order of trace.effects.
Section trace(const trace::Trace& trace, Detail detail);

// The smallest effects that this campaign would have shown, and how to see smaller ones; without
// blocks where that is not known.
Section detectable_effects(const trace::Trace& trace);

// Tests that settle an effect, in one line: "run 2 tests with humidity_pct = 20; 2 with
// humidity_pct = 80, otherwise like V07, to see whether humidity_pct has an effect (85 % chance
// of a clear answer)".
std::string design_in_short(const trace::Design& design);

// The missing effects and the gain of adding them, in one line.
std::string trace_in_short(const trace::Trace& trace);

// Findings that are not delivered: "not confirmed: v_rel_mm_s (p = 0.001, would take 15.0 to about
// 10.2 MPa)"; empty: none.
std::string not_confirmed(const trace::Trace& trace);

// "humidity_pct", "friction_work (from s_mm)".
std::string lead_name(const trace::Lead& lead);
// "friction_work (from s_mm)", "humidity_pct", "psi x s_mm".
std::string cause_text(const trace::TracedEffect& effect);

// The file's own name of a law's input that an effect brings: "Ra [um]" for "Ra__um_"; other names
// as they are.
std::string column_name(const std::string& input, const std::vector<trace::Trace>& traces);

// "on mu", "on the limit", "added to tau_R".
const char* site_text(effects::ActsOn acts_on);

} // namespace frictab::words
