// Sections of a study's page and of its report in the terminal.
#pragma once

#include <string>
#include <vector>

#include "study/factor_levels.h"
#include "study/tally.h"
#include "words/document.h"

namespace frictab::study {

// How often each law is the best, over the campaigns that compare laws.
words::Section laws_over_campaigns(const Tally& tally);

// Parameters over campaigns and over the levels of each factor. `notes`: on factors that are not
// among `factors`.
words::Section parameters_over_campaigns(const Tally& tally,
                                         const std::vector<FactorLevels>& factors,
                                         const std::vector<std::string>& notes);
// Campaigns whose parameters do not belong to those of the others.
words::Section outlying_campaigns(const Plan& plan, const Tally& tally);

// The first campaigns that have a result.
words::Section first_campaigns(const Plan& plan, const Tally& tally);

} // namespace frictab::study
