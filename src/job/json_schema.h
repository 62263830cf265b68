// The keys of the job file as a JSON Schema, so that an editor completes and checks them.
#pragma once

#include <string>

namespace frictab::job {

// Returns the schema in draft 7, which editors of TOML read. A file that fits it need not be a job
// that runs: the schema has keys, types, bounds and names, but no rules across keys.
std::string json_schema();

} // namespace frictab::job
