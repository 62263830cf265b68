// Laws of the literature that come with the program as texts: templates/laws/*.toml, each table a
// law as a job's [models.NAME] has it. A job has them by name (models.use); what is calibrated
// unasked stays the registry, for of many laws the best is best by luck.
#pragma once

#include <string>
#include <string_view>

#include "models/law.h"

namespace frictab::job {

// In order of their names.
const models::Laws& literature();

// The registry's law or the literature's; nullptr where there is none.
const models::Law* find_shipped_law(std::string_view name);
std::vector<std::string> shipped_law_names();

// The law as a job may have it, to be changed: [models.NAME] and what stands below. Empty where
// `name` is no law of the literature.
std::string literature_text(const std::string& name);

} // namespace frictab::job
