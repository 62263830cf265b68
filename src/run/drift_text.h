// Drift of tables and routines from their laws, as text.
#pragma once

#include <string>

#include "verify/verify.h"

namespace frictab::run {

// brief: drift, rows outside the range, fixed states. full: also the drift below the tested contact
// normal stresses and the rounding errors of single precision. verbose: also the coefficients of
// traced effects.
enum class Detail { brief, full, verbose };

std::string drift_text(const verify::Verification& verification, Detail detail);
// Summarises all tables in one line without a line break; empty if nothing was verified.
std::string drift_in_short(const verify::Verification& verification);

} // namespace frictab::run
