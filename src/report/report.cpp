// report.html: fills templates/report/report.html section by section.
#include "report/report.h"

#include <cctype>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "core/template.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

std::string shown_path(const std::string& path) {
  const std::filesystem::path p(path);
  return p.is_absolute() ? p.filename().string() : path;
}

std::string shown_unit(const std::string& unit) {
  if (unit == "degC") return "\u00B0C";
  return unit.empty() || unit == "1" ? "\u2013" : svg::escape(unit);
}

namespace {

// Links to a file next to the page; characters that RFC 3986 reserves are written as %XX.
std::string link_to(const std::string& file) {
  std::string link = "./";
  for (const char c : shown_path(file))
    if (std::isalnum(static_cast<unsigned char>(c)) ||
        std::string_view("-._~/").find(c) != std::string_view::npos)
      link += c;
    else
      link += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return link;
}

} // namespace

std::string report_html(const ReportInput& input) {
  TemplateValues page;
  page.text["title"] = svg::escape(shown_path(input.title));
  page.text["style"] = std::string(embedded_template("report/style.css"));
  page.flags["synthetic"] = input.calibration.synthetic;
  add_verdict(page, input);
  add_drift_summary(page, input);
  add_ranking(page, input);
  add_comparisons(page, input);
  add_errors(page, input);
  add_experiment_errors(page, input);
  add_polynomial(page, input);
  add_law_with_data(page, input);
  add_predicted_strokes(page, input);
  add_wiring(page, input);
  add_conditional(page, input);
  add_trace(page, input);
  add_published_figures(page, input);
  add_data(page, input);
  add_tables(page, input);
  add_drift(page, input);
  std::vector<TemplateValues>& files = page.lists["files"];
  for (const std::string& file : input.files)
    files.push_back({{{"path", svg::escape(shown_path(file))}, {"link", link_to(file)}}, {}, {}});
  page.flags["has_files"] = !files.empty();
  return render_template("report/report.html", page);
}

} // namespace frictab::report
