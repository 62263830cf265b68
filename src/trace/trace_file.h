// trace.json: traces as JSON and back.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trace/trace.h"

namespace frictab::trace {

// Schema frictab/trace/1 of the first trace; further traced laws are its `others`.
std::string trace_json(const std::vector<Trace>& traces, bool synthetic);
// Everything but curves' points and the extended fits, which calibration.json holds.
std::vector<Trace> parse_traces(std::string_view text, const std::string& file);

} // namespace frictab::trace
