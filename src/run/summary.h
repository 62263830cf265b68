// What a pipeline found, as text that is read in ten seconds, or as JSON.
#pragma once

#include <string>

#include "run/drift_text.h"
#include "run/pipeline.h"

namespace frictab::run {

// brief ends with the findings in a few lines; full says all that the report says.
std::string summary_text(const Pipeline& pipeline, Detail detail);
std::string summary_json(const Pipeline& pipeline);

} // namespace frictab::run
