// Drift of tables and routines from their laws, in words and tables. MPa.
#pragma once

#include <string>

#include "verify/verification.h"
#include "words/document.h"

namespace frictab::words {

// A row per law: drift of its table and of the routines made from it, and whether that passed. Then
// rows outside the range and states that are fixed; in full also the drift below the tested contact
// normal stresses and the rounding errors of single precision.
Section drift(const verify::Verification& verification, Detail detail);

// A row per table and routine, with all figures.
Table drift_of_each(const verify::Verification& verification);

// The largest drift of any table over its whole range; proven: no state drifts further.
struct Drift {
  double value_MPa = 0;
  bool proven = true;
};
Drift largest_drift(const verify::Verification& verification);

// All tables in one line; empty if nothing was verified.
Text drift_in_short(const verify::Verification& verification);

} // namespace frictab::words
