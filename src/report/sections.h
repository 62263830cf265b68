// The parts of report.html that have pictures: what words/ says, with plots added.
#pragma once

#include <string>

#include "report/report.h"
#include "words/document.h"

namespace frictab::report {

words::Section ranking_with_bars(const ReportInput& input);
words::Section errors_by_test(const ReportInput& input);
words::Section all_laws_with_data(const ReportInput& input); // Fig. 1 of the paper it follows
words::Section best_law_with_data(const ReportInput& input);
words::Section strokes(const ReportInput& input);
words::Section traces_with_plots(const ReportInput& input);
words::Section each_law(const ReportInput& input); // against the measurement
words::Section tables_with_data(const ReportInput& input);

// Draws the range of the data along an axis of a table (SVG); a dash where the data do not have
// that column.
words::Cell reach_cell(const ReportInput& input, const table::TableAxis& axis);

} // namespace frictab::report
