// What `explain` knows beside laws, effects, targets, quantities and keys.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/explanation.h"

namespace frictab::cli {

const std::vector<std::string>& topic_names();

// nullopt where no topic is called so.
std::optional<Explanation> explain_topic(const std::string& name);

} // namespace frictab::cli
