// Lines on the input data, for the pages that show them.
#pragma once

#include "calibrate/judgement.h"
#include "core/template.h"
#include "data/dataset.h"

namespace frictab::report {

// Fills in the list "data": files, tests, rows, and what was left out, derived or implausible.
void add_data_lines(TemplateValues& page, const data::Dataset& training,
                    const data::Dataset& validation, calibrate::JudgedBy judged_by);

} // namespace frictab::report
