// What was read and how, for the pages that show it.
#pragma once

#include "calibrate/judgement.h"
#include "codegen/template.h"
#include "data/dataset.h"

namespace frictab::report {

// The list "data": files, tests, rows, what was left out, derived, implausible.
void add_data_lines(codegen::TemplateValues& page, const data::Dataset& training,
                    const data::Dataset& validation, calibrate::JudgedBy judged_by);

} // namespace frictab::report
