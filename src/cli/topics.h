// Topics of `explain` other than laws, effects, targets, quantities and keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/explanation.h"

namespace frictab::cli {

const std::vector<std::string>& topic_names();

// Explains a topic; nullopt if the name is unknown.
std::optional<Explanation> explain_topic(const std::string& name);

} // namespace frictab::cli
