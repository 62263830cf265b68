// The parts of report.html as template values. All text in them is HTML, escaped where it comes
// from users or files.
#pragma once

#include <string>
#include <vector>

#include "codegen/template.h"
#include "report/report.h"

namespace frictab::report {

using Items = std::vector<TemplateValues>;

Items verdict(const ReportInput& input); // paragraphs, `html`

// Ranking rows, and the axis above their bars.
Items ranking(const Calibration& calibration);
std::string bar_axis(const Calibration& calibration);
std::string ranking_note(const Calibration& calibration);

Items data_sets(const ReportInput& input);
Items columns(const ReportInput& input); // canonical quantities with their ranges
Items tables(const std::vector<Table>& tables);
Items records(const Verification& verification);

} // namespace frictab::report
