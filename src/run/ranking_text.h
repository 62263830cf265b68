// The ranking of the laws by error, as text.
#pragma once

#include <string>

#include "calibrate/calibration.h"

namespace frictab::run {

// Returns the table of laws, the sentences that compare them, remarks, and the laws with a gain per
// experiment.
std::string ranking_text(const calibrate::Calibration& calibration);
// Returns the best law, its error and the laws that may be as good, in one line without a line
// break.
std::string best_law_in_short(const calibrate::Calibration& calibration);

} // namespace frictab::run
