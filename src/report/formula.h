// A law's formula on a page.
#pragma once

#include <string>

#include "models/law.h"

namespace frictab::report {

// Of a user's own law as MathML, one line for the formula and one for each of its parts; of others
// the text that they describe themselves with. Safe for HTML.
std::string formula_html(const models::Law& law);

} // namespace frictab::report
