// Prints an explanation for people.
#pragma once

#include "cli/explanation.h"

namespace frictab::cli {

void print_explanation(const Explanation& it);

} // namespace frictab::cli
