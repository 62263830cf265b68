// The keys of the job file as a JSON Schema, so that an editor completes and checks them.
#pragma once

#include <string>

namespace frictab::job {

// Draft 7, which editors of TOML read. What fits it need not be a job that runs: it knows keys,
// types, bounds and names, not how they go together.
std::string json_schema();

} // namespace frictab::job
