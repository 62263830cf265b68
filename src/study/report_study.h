// What a study found over all of its campaigns: campaigns.csv and report.html.
#pragma once

#include <string>
#include <vector>

#include "study/tally.h"

namespace frictab::study {

// Reads the results one by one and writes both files into the study's directory, whatever is
// missing. Throws InputError for results that cannot be read, and where there are none.
Tally report_study(const Plan& plan);

// The page; the same tally gives the same bytes.
std::string study_html(const Plan& plan, const Tally& tally);

// A few lines for people.
std::string report_text(const Plan& plan, const Tally& tally);
std::string report_json(const Plan& plan, const Tally& tally);

} // namespace frictab::study
