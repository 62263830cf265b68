// Sections of a study's page as values of its template.
#pragma once

#include <string>
#include <vector>

#include "codegen/template.h"
#include "study/factor_levels.h"
#include "study/tally.h"

namespace frictab::study {

// Parameters over campaigns and over the levels of each factor, and the campaigns that do not
// belong to the others. `notes`: of factors that are not among them.
void add_parameters(codegen::TemplateValues& page, const Plan& plan, const Tally& tally,
                    const std::vector<FactorLevels>& factors,
                    const std::vector<std::string>& notes);

// The first campaigns that have a result.
void add_campaigns(codegen::TemplateValues& page, const Plan& plan, const Tally& tally);

} // namespace frictab::study
