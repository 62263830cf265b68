// The ranking table: errors with intervals as small bars, parameters, remarks.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "report/number.h"
#include "report/published.h"
#include "report/sections.h"
#include "report/svg.h"

namespace frictab::report {

namespace {

constexpr double bar_width = 230, bar_margin = 10;

svg::Axis bar_scale(const Calibration& calibration) {
  double high = 0;
  for (const ModelFit& fit : calibration.fits)
    for (const double value : {fit.validation.mae_MPa, fit.validation.mae_interval.high})
      if (std::isfinite(value)) high = std::max(high, value);
  return svg::nice_axis(0, high > 0 ? high : 1, "", 4);
}

double place(double value, const svg::Axis& axis) {
  return bar_margin + (bar_width - 2 * bar_margin) * value / axis.high;
}

std::string grid(const svg::Axis& axis) {
  std::string path;
  for (const double tick : axis.ticks)
    path += fmt::format("M{} 0v20", svg::pixel(place(tick, axis)));
  return "<path class=\"grid\" d=\"" + path + "\"/>";
}

std::string bar(const ModelFit& fit, const svg::Axis& axis) {
  const Metrics& v = fit.validation;
  if (!std::isfinite(v.mae_MPa)) return "";
  std::string marks =
      grid(axis) + fmt::format("<rect class=\"mae\" x=\"{}\" y=\"5\" width=\"{}\" height=\"10\"/>",
                               svg::pixel(place(0, axis)),
                               svg::pixel(place(v.mae_MPa, axis) - place(0, axis)));
  if (has_interval(v))
    marks += fmt::format("<path class=\"whisker\" d=\"M{} 10H{}m0 -4v8M{} 6v8\"/>",
                         svg::pixel(place(v.mae_interval.low, axis)),
                         svg::pixel(place(v.mae_interval.high, axis)),
                         svg::pixel(place(v.mae_interval.low, axis)));
  const std::string title = fmt::format("MAE {} MPa, 95 % interval {}", stress(v.mae_MPa),
                                        interval_text(v, v.mae_interval));
  return fmt::format("<svg class=\"bar\" role=\"img\" viewBox=\"0 0 230 20\" aria-label=\"{}\">"
                     "<title>{}</title>{}</svg>",
                     title, title, marks);
}

std::string remarks(const ModelFit& fit) {
  std::string html;
  for (const std::string& remark : fit.remarks)
    html += "<br/><span class=\"remark\">" + svg::escape(remark) + "</span>";
  return html;
}

} // namespace

std::string bar_axis(const Calibration& calibration) {
  const svg::Axis axis = bar_scale(calibration);
  std::string marks;
  for (const double tick : axis.ticks)
    marks += fmt::format("<text class=\"tick\" text-anchor=\"middle\" x=\"{}\" y=\"17\">{}</text>",
                         svg::pixel(place(tick, axis)), number(tick));
  return "<svg class=\"bar\" role=\"img\" viewBox=\"0 0 230 20\" aria-label=\"Scale of the bars, "
         "MPa\"><title>Scale of the bars, MPa</title>" +
         marks + "</svg>";
}

std::string ranking_note(const Calibration& calibration) {
  if (calibration.fits.empty()) return "";
  const Metrics& v = calibration.fits.front().validation;
  const Metrics& t = calibration.fits.front().training;
  return fmt::format("Errors of tau_R on {} experiments ({} rows) that were not used for "
                     "calibration; calibrated with {} experiments ({} rows). MAE: mean absolute "
                     "error. Intervals: whole experiments resampled.",
                     thousands(v.n_experiments), thousands(v.n_rows), thousands(t.n_experiments),
                     thousands(t.n_rows));
}

Items ranking(const Calibration& calibration) {
  Items items;
  const svg::Axis axis = bar_scale(calibration);
  for (const ModelFit& fit : calibration.fits) {
    const Metrics& v = fit.validation;
    items.emplace_back().text = {{"rank", std::to_string(items.size() + 1)},
                                 {"css", items.empty() ? "best" : "other"},
                                 {"name", svg::escape(fit.model.law->name)},
                                 {"title", svg::escape(fit.model.law->title)},
                                 {"mae", stress(v.mae_MPa)},
                                 {"interval", interval_text(v, v.mae_interval)},
                                 {"bar", bar(fit, axis)},
                                 {"rmse", stress(v.rmse_MPa)},
                                 {"bias", stress(v.bias_MPa)},
                                 {"training", stress(fit.training.mae_MPa)},
                                 {"parameters", svg::escape(parameters_text(fit))},
                                 {"remarks", remarks(fit)}};
  }
  return items;
}

} // namespace frictab::report
