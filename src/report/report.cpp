// report.html: fills the page's template.
#include "report/report.h"

#include "report/law_plots.h"
#include "report/number.h"
#include "report/published.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab {

namespace {

using report::Items;

Items left_out(const Calibration& calibration) {
  Items items;
  for (const std::string& why : calibration.left_out)
    items.emplace_back().text["why"] = svg::escape(why);
  return items;
}

Items published(const Calibration& calibration) {
  Items items;
  for (const PublishedFigure& figure : published_figures(calibration))
    items.emplace_back().text = {{"what", svg::escape(figure.what)},
                                 {"published", svg::escape(figure.published)},
                                 {"ours", svg::escape(figure.ours)}};
  return items;
}

PlotSheet plot_sheet(const ReportInput& input) {
  std::vector<std::string> names;
  for (const ModelFit& fit : input.calibration.fits)
    names.push_back(fit.model.law->name);
  return law_plots(input.validation.values("tau_R_MPa"), input.predicted, names);
}

Items plots(const ReportInput& input, const PlotSheet& sheet) {
  Items items;
  for (const LawPlots& law : sheet.laws) {
    const Law& about = *input.calibration.fits[items.size()].model.law;
    items.emplace_back().text = {
        {"rank", std::to_string(items.size() + 1)},
        {"name", svg::escape(about.name)},
        {"title", svg::escape(about.title)},
        {"formula", svg::escape(about.formula)},
        {"reference", svg::escape(about.reference)},
        {"agreement", law.agreement},
        {"residuals", law.residuals},
        {"outside", law.outside.empty() ? "" : "<p class=\"soft\">" + law.outside + "</p>"}};
  }
  return items;
}

Items files(const ReportInput& input) {
  Items items;
  for (const std::string& file : input.files)
    items.emplace_back().text["path"] = svg::escape(file);
  return items;
}

} // namespace

std::string report_html(const ReportInput& input) {
  const Calibration& calibration = input.calibration;
  const bool draw = !input.predicted.empty() && input.validation.rows() > 0;
  const PlotSheet sheet = draw ? plot_sheet(input) : PlotSheet{};
  TemplateValues values;
  values.text = {{"title", svg::escape(input.title)},
                 {"ranking_note", report::ranking_note(calibration)},
                 {"bar_axis", report::bar_axis(calibration)},
                 {"legend", sheet.legend},
                 {"data_hash", svg::escape(calibration.data_hash)},
                 {"max_drift", number(input.verification.max_drift_MPa)}};
  values.lists = {{"verdict", report::verdict(input)},
                  {"ranking", report::ranking(calibration)},
                  {"left_out", left_out(calibration)},
                  {"published", published(calibration)},
                  {"plots", plots(input, sheet)},
                  {"data", report::data_sets(input)},
                  {"columns", report::columns(input)},
                  {"tables", report::tables(input.tables)},
                  {"records", report::records(input.verification)},
                  {"files", files(input)}};
  values.flags = {{"synthetic", calibration.synthetic},
                  {"has_laws", !calibration.fits.empty()},
                  {"has_plots", draw},
                  {"has_left_out", !calibration.left_out.empty()},
                  {"has_columns", !values.lists["columns"].empty()},
                  {"has_tables", !input.tables.empty()},
                  {"has_records", !input.verification.records.empty()},
                  {"has_files", !input.files.empty()}};
  return render_template("report/page.html", values);
}

} // namespace frictab
