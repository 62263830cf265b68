// What a pipeline found, as text that is read in ten seconds, or as JSON.
#pragma once

#include <string>

#include "run/pipeline.h"

namespace frictab::run {

std::string summary_text(const Pipeline& pipeline);
std::string drift_text(const verify::Verification& verification); // the drift section alone
std::string summary_json(const Pipeline& pipeline);

} // namespace frictab::run
