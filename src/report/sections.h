// The parts of report.html as values of its template, one function per section.
#pragma once

#include <string>

#include "codegen/template.h"
#include "report/report.h"

namespace frictab {

// One paragraph (HTML): the best law on unseen experiments, and what the fixed constants give.
std::string verdict(const ReportInput& input);

void add_drift_summary(TemplateValues& page, const ReportInput& input);
void add_ranking(TemplateValues& page, const ReportInput& input); // with the plots
void add_comparisons(TemplateValues& page, const ReportInput& input);
void add_errors(TemplateValues& page, const ReportInput& input); // with the noise floors
void add_conditional(TemplateValues& page, const ReportInput& input);
void add_trace(TemplateValues& page, const ReportInput& input);
void add_published_figures(TemplateValues& page, const ReportInput& input);
void add_data(TemplateValues& page, const ReportInput& input);
void add_tables(TemplateValues& page, const ReportInput& input);
void add_drift(TemplateValues& page, const ReportInput& input);

// An absolute path of a user's machine becomes the file's name.
std::string shown_path(const std::string& path);

// Escaped; "degC" as people write it, nothing for "1".
std::string shown_unit(const std::string& unit);

} // namespace frictab
