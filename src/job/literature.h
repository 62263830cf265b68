// Laws that come with the program as texts: templates/laws/*.toml, each table a law in the form of
// a job's [models.NAME]. Those with an `order` belong to the registry (models::all_laws) and are
// calibrated by default. The others are laws of the literature, which a job requests by name
// (models.use), because the best of many candidates looks too good by chance.
#pragma once

#include <string>

#include "models/law.h"

namespace frictab::job {

// Returns the laws of the literature in the order of their texts; they follow those of the
// registry.
const models::Laws& literature();

// Returns the law as lines of a job, to be changed there: [models.NAME] and its keys. Empty if
// `name` is not a law of the literature.
std::string literature_text(const std::string& name);

} // namespace frictab::job
