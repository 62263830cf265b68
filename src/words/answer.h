// The first lines of a summary and of a page: which law, how wrong, how far its tables and routines
// drift, what it lacks.
#pragma once

#include <vector>

#include "calibrate/calibration.h"
#include "trace/trace.h"
#include "verify/forms.h"
#include "verify/verification.h"
#include "words/document.h"

namespace frictab::words {

struct Answers {
  const calibrate::Calibration* calibration = nullptr; // null: not calibrated
  const verify::Verification* verification = nullptr;  // null: not verified
  const std::vector<trace::Trace>& traces;
  const std::vector<verify::FormComparison>& forms; // with times; empty: not measured
};

// One line each; without those that are not known.
Section in_short(const Answers& answers);

} // namespace frictab::words
