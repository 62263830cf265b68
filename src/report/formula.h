// A law's formula as HTML.
#pragma once

#include <string>

#include "models/law.h"

namespace frictab::report {

// Writes a user's own law as MathML, one line for the formula and one for each of its parts; for
// other laws their own text. Safe for HTML.
std::string formula_html(const models::Law& law);

} // namespace frictab::report
