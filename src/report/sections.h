// The parts of report.html as values of its template, one function per section.
#pragma once

#include <string>

#include "codegen/template.h"
#include "report/report.h"

namespace frictab::report {

void add_verdict(codegen::TemplateValues& page, const ReportInput& input);
void add_drift_summary(codegen::TemplateValues& page, const ReportInput& input);
void add_ranking(codegen::TemplateValues& page, const ReportInput& input); // with the plots
void add_comparisons(codegen::TemplateValues& page, const ReportInput& input);
void add_errors(codegen::TemplateValues& page, const ReportInput& input); // with the noise floors
void add_experiment_errors(codegen::TemplateValues& page, const ReportInput& input);
void add_polynomial(codegen::TemplateValues& page, const ReportInput& input);
void add_law_with_data(codegen::TemplateValues& page, const ReportInput& input);
void add_predicted_strokes(codegen::TemplateValues& page, const ReportInput& input);
void add_wiring(codegen::TemplateValues& page, const ReportInput& input);
void add_conditional(codegen::TemplateValues& page, const ReportInput& input);
void add_trace(codegen::TemplateValues& page, const ReportInput& input);
void add_published_figures(codegen::TemplateValues& page, const ReportInput& input);
void add_data(codegen::TemplateValues& page, const ReportInput& input);
void add_tables(codegen::TemplateValues& page, const ReportInput& input);
void add_drift(codegen::TemplateValues& page, const ReportInput& input);

// Draws the range of the data along an axis of a table (SVG); a dash where the data do not have
// that column.
std::string reach_bar(const ReportInput& input, const table::TableAxis& axis);

// Reduces an absolute path of a user's machine to the file's name.
std::string shown_path(const std::string& path);

// Escapes a unit; "degC" in the usual notation, empty for "1".
std::string shown_unit(const std::string& unit);

} // namespace frictab::report
