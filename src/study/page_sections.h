// Sections of a study's page as values of its template.
#pragma once

#include <string>
#include <vector>

#include "core/template.h"
#include "study/factor_levels.h"
#include "study/tally.h"

namespace frictab::study {

// Adds parameters over campaigns and over the levels of each factor, and outlying campaigns.
// `notes`: on factors that are not among `factors`.
void add_parameters(TemplateValues& page, const Plan& plan, const Tally& tally,
                    const std::vector<FactorLevels>& factors,
                    const std::vector<std::string>& notes);

// Adds the first campaigns that have a result.
void add_campaigns(TemplateValues& page, const Plan& plan, const Tally& tally);

} // namespace frictab::study
