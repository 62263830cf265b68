// The parts of report.html as values of its template, one function per section.
#pragma once

#include <string>

#include "core/template.h"
#include "report/report.h"

namespace frictab::report {

void add_verdict(TemplateValues& page, const ReportInput& input);
void add_drift_summary(TemplateValues& page, const ReportInput& input);
void add_ranking(TemplateValues& page, const ReportInput& input); // with the plots
void add_comparisons(TemplateValues& page, const ReportInput& input);
void add_errors(TemplateValues& page, const ReportInput& input); // with the noise floors
void add_experiment_errors(TemplateValues& page, const ReportInput& input);
void add_polynomial(TemplateValues& page, const ReportInput& input);
void add_law_with_data(TemplateValues& page, const ReportInput& input);
void add_predicted_strokes(TemplateValues& page, const ReportInput& input);
void add_wiring(TemplateValues& page, const ReportInput& input);
void add_conditional(TemplateValues& page, const ReportInput& input);
void add_trace(TemplateValues& page, const ReportInput& input);
void add_published_figures(TemplateValues& page, const ReportInput& input);
void add_data(TemplateValues& page, const ReportInput& input);
void add_tables(TemplateValues& page, const ReportInput& input);
void add_drift(TemplateValues& page, const ReportInput& input);

// Draws the range of the data along an axis of a table (SVG); a dash where the data do not have
// that column.
std::string reach_bar(const ReportInput& input, const table::TableAxis& axis);

// Reduces an absolute path of a user's machine to the file's name.
std::string shown_path(const std::string& path);

// Escapes a unit; "degC" in the usual notation, empty for "1".
std::string shown_unit(const std::string& unit);

} // namespace frictab::report
