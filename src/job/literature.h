// Laws of the literature that come with the program as texts: templates/laws/*.toml, each table a
// law in the form of a job's [models.NAME]. A job gets one by naming it (models.use). By default
// only the registry is calibrated, because the best of many candidates looks too good by chance.
#pragma once

#include <string>

#include "models/law.h"

namespace frictab::job {

// Returns the laws in order of their names; they follow those of the registry.
const models::Laws& literature();

// Returns the law as lines of a job, to be changed there: [models.NAME] and its keys. Empty where
// `name` is not a law of the literature.
std::string literature_text(const std::string& name);

} // namespace frictab::job
