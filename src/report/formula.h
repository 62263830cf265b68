// A law's formula as HTML.
#pragma once

#include <string>

#include "models/law.h"

namespace frictab::report {

// Writes a law as MathML: a user's own with one line for the formula and one for each of its parts,
// a registered one as the piece that tables sample and tau_R made from it. Trained laws and very
// long formulas as their own text. Safe for HTML.
std::string formula_html(const models::Model& model);

} // namespace frictab::report
