// Laws of the literature that come with the program as texts: templates/laws/*.toml, each table a
// law as a job's [models.NAME] has it. A job has them by name (models.use); what is calibrated
// unasked stays the registry, for of many laws the best is best by luck.
#pragma once

#include <string>

#include "models/law.h"

namespace frictab::job {

// Behind the registry's, in order of their names.
const models::Laws& literature();

// The law as a job may have it, to be changed: [models.NAME] and what stands below. Empty where
// `name` is no law of the literature.
std::string literature_text(const std::string& name);

} // namespace frictab::job
