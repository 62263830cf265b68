// How far tables and routines are from their laws, as text.
#pragma once

#include <string>

#include "verify/verify.h"

namespace frictab::run {

// brief: what is off, what is outside, what is held. full: also below the tested contact normal
// stresses, and what single precision rounds. verbose: also the coefficients of traced effects.
enum class Detail { brief, full, verbose };

std::string drift_text(const verify::Verification& verification, Detail detail);
// One line without its end, of all tables together; empty where nothing was verified.
std::string drift_in_short(const verify::Verification& verification);

} // namespace frictab::run
