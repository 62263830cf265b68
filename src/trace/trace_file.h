// Conversion of traces to trace.json and back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trace/trace.h"

namespace frictab::trace {

// Returns the first trace in schema frictab/trace/1; traces of further laws are its `others`.
std::string trace_json(const std::vector<Trace>& traces, bool synthetic);
// Reads all except the points of curves and the extended fits, which are in calibration.json.
std::vector<Trace> parse_traces(std::string_view text, const std::string& file);

} // namespace frictab::trace
