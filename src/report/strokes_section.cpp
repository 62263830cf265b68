// Draws each test over its course, measured and predicted by the best law.
#include <algorithm>

#include "calibrate/input_columns.h"
#include "calibrate/recommended.h"
#include "report/sections.h"
#include "report/state_plots.h"
#include "report/svg.h"
#include "words/judged.h"
#include "words/numbers.h"

namespace frictab::report {

namespace {

constexpr std::size_t stroke_points = 25; // enough for the shape of a stroke

// Returns means over blocks of neighbouring rows.
std::vector<double> condensed(std::span<const double> values) {
  const std::size_t width = (values.size() + stroke_points - 1) / stroke_points;
  std::vector<double> means;
  for (std::size_t first = 0; first < values.size(); first += width) {
    const std::size_t count = std::min(width, values.size() - first);
    double sum = 0;
    for (const double value : values.subspan(first, count))
      sum += value;
    means.push_back(sum / static_cast<double>(count));
  }
  return means;
}

// Column over which strokes are drawn: the first of these that the data have and that varies, else
// the row.
std::string stroke_abscissa(const data::Dataset& data) {
  for (const char* name : {"s_mm", "time_s"})
    if (data.has(name) && span_of(data.values(name))) return name;
  return "";
}

struct StrokeAxes {
  std::string over;
  svg::Axis x, y;
};

StrokeAxes stroke_axes(const data::Dataset& data) {
  StrokeAxes axes;
  axes.over = stroke_abscissa(data);
  double most_rows = 1;
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    most_rows = std::max(most_rows, static_cast<double>(data.first_row[e + 1] - data.first_row[e]));
  const auto x = axes.over.empty() ? std::pair(0.0, most_rows) : *span_of(data.values(axes.over));
  const auto tau = span_of(data.values("tau_R_MPa")).value_or(std::pair(0.0, 1.0));
  axes.x = svg::nice_axis(x.first, x.second, 2, axes.over.empty() ? "row" : axis_name(axes.over));
  axes.y = svg::nice_axis(std::min(0.0, tau.first), tau.second, 2, "");
  return axes;
}

words::Picture stroke_of(const data::Dataset& data, std::span<const double> predicted,
                         std::size_t e, const StrokeAxes& axes) {
  const std::size_t first = data.first_row[e], rows = data.first_row[e + 1] - first;
  std::vector<double> x(rows);
  for (std::size_t i = 0; i < rows; ++i)
    x[i] = static_cast<double>(i);
  if (!axes.over.empty()) {
    const auto values = data.values(axes.over).subspan(first, rows);
    x.assign(values.begin(), values.end());
  }
  const auto measured = data.values("tau_R_MPa").subspan(first, rows);
  const std::vector<double> at = condensed(x);
  svg::Plot plot(150, 84, axes.x, axes.y);
  plot.line(at, condensed(measured), {"#1d5491", 1.4, "", false});
  plot.line(at, condensed(predicted.subspan(first, rows)), {"#c2410c", 1.4, "4 2", false});
  const std::string& name = data.experiments[e];
  return {plot.text("test " + name, "measured (solid) and predicted (dashed)"), name};
}

words::Pictures strokes_of(const data::Dataset& data, std::span<const double> predicted) {
  const StrokeAxes axes = stroke_axes(data);
  words::Pictures out{"strokes"};
  for (std::size_t e = 0; e < data.experiments.size(); ++e)
    out.pictures.push_back(stroke_of(data, predicted, e, axes));
  return out;
}

} // namespace

words::Section strokes(const ReportInput& input) {
  words::Section section{"strokes", "Strokes", "Strokes: measured and predicted"};
  const data::Dataset &data = input.validation, &training = input.training;
  if (input.predicted.empty() || !data.has("tau_R_MPa") || data.rows() == 0) return section;
  const calibrate::ModelFit& best = calibrate::best_fit(input.calibration);
  section.say(words::symbol("tau_R") + " of each test as measured (solid) and as " +
              best.model.law->name +
              " predicts it (dashed), on the same axes. Vertical: " + words::symbol("tau_R") +
              ", MPa. Each line is condensed to at most 25 means of neighbouring rows.");
  words::Section judged{"", "", "Judged by: " + words::count_of(data.experiments.size(), "test")};
  judged.add(strokes_of(data, input.predicted[calibrate::best_place(input.calibration)]));
  section.add(std::move(judged));
  if (!on_other_experiments(input.calibration.judged_by) || !training.has("tau_R_MPa") ||
      !calibrate::missing_inputs(models::AssembledLaw(best.model).inputs, training).empty())
    return section;
  words::Section trained{"", "",
                         "Trained on: " + words::count_of(training.experiments.size(), "test")};
  trained.foldable = true;
  trained.open = false;
  trained.add(strokes_of(training, calibrate::predict(best.model, training)));
  section.add(std::move(trained));
  return section;
}

} // namespace frictab::report
