// Drift of tables and routines from their laws, in words and tables. MPa.
#pragma once

#include <string>

#include "verify/verification.h"
#include "words/document.h"

namespace frictab::words {

// brief: what a user has to know. full: everything that a page has. verbose: also coefficients.
enum class Detail { brief, full, verbose };

// A row per law: drift of its table and of the routines made from it, and whether that passed. Then
// rows outside the range and states that are fixed; in full also the drift below the tested contact
// normal stresses and the rounding errors of single precision.
Section drift(const verify::Verification& verification, Detail detail);

// A row per table and routine, with all figures.
Table drift_of_each(const verify::Verification& verification);

// All tables in one line; empty if nothing was verified.
Text drift_in_short(const verify::Verification& verification);

} // namespace frictab::words
