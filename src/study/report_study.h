// Results over all campaigns of a study: campaigns.csv and report.html.
#pragma once

#include <string>
#include <vector>

#include "study/tally.h"

namespace frictab::study {

// Reads the results one by one and writes both files into the study's directory; campaigns may be
// missing. Throws InputError for a result that cannot be read, and for a study without any.
Tally report_study(const Plan& plan);

// Writes the page; the same tally gives the same bytes.
std::string study_html(const Plan& plan, const Tally& tally);

// Writes a few lines for people.
std::string report_text(const Plan& plan, const Tally& tally);
std::string report_json(const Plan& plan, const Tally& tally);

} // namespace frictab::study
