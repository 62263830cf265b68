// Which law misses by how much, as text.
#pragma once

#include <string>

#include "calibrate/calibration.h"

namespace frictab::run {

// The table of laws, the sentences that compare them, remarks, and laws with a gain per experiment.
std::string ranking_text(const calibrate::Calibration& calibration);
// The best law, its error and the laws that may be as good: one line without its end.
std::string best_law_in_short(const calibrate::Calibration& calibration);

} // namespace frictab::run
