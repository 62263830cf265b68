// process.json: everything that a judgement of a process found.
#pragma once

#include <string>

#include "process/process.h"

namespace frictab::process {

// Schema frictab/process/1. `in_short`: the lines that users read first.
std::string process_json(const Process& process, const std::vector<std::string>& in_short);

} // namespace frictab::process
