// What was read and how, for the pages that show it.
#pragma once

#include "codegen/template.h"
#include "data/dataset.h"

namespace frictab::report {

// The list "data": files, tests, rows, what was left out, derived, implausible. `each`: the
// training tests validate, each left out in turn, and `validation` is empty.
void add_data_lines(codegen::TemplateValues& page, const data::Dataset& training,
                    const data::Dataset& validation, bool each);

} // namespace frictab::report
