// Adds plots to what a trace found: residuals before and after, the effect between them.
#include <cmath>

#include <fmt/format.h>

#include "calibrate/input_columns.h"
#include "report/law_plots.h"
#include "report/sections.h"
#include "report/state_plots.h"
#include "words/judged.h"
#include "words/numbers.h"
#include "words/trace.h"

namespace frictab::report {

namespace {

using Values = std::span<const double>;

constexpr double plot_width = 300, plot_height = 220;
constexpr std::size_t cells_wide = 75, cells_high = 55;

// Draws rows as cells.
void draw_cloud(svg::Plot& plot, Values x, Values y, const svg::Axis& x_axis,
                const svg::Axis& y_axis) {
  const svg::Density cells = svg::bin(x, y, x_axis, y_axis, cells_wide, cells_high);
  std::uint32_t most = 1;
  for (const std::uint32_t count : cells.counts)
    most = std::max(most, count);
  plot.density(cells, svg::count_classes(most, 6));
}

double mean_of(Values values) {
  double sum = 0;
  for (const double value : values)
    sum += value;
  return sum / static_cast<double>(values.size());
}

struct Cloud {
  Values x, y;
};

std::string residual_plot(const Cloud& cloud, const svg::Axis& x_axis, const svg::Axis& y_axis,
                          const std::string& title) {
  svg::Plot plot(plot_width, plot_height, x_axis, y_axis);
  draw_cloud(plot, cloud.x, cloud.y, x_axis, y_axis);
  const double ends[] = {x_axis.low, x_axis.high}, zero[] = {0, 0};
  plot.line(ends, zero, {"#222", 1, "", false});
  const RunningBand band = running_band(cloud.x, cloud.y);
  plot.line(band.x, band.median, {"#c2410c", 2, "", true});
  plot.line(band.x, band.low, {"#c2410c", 1, "4 3", true});
  plot.line(band.x, band.high, {"#c2410c", 1, "4 3", true});
  return plot.text(title, "density of rows, with running median and 10 and 90 % quantiles");
}

// ---- effects between tests: one dot per test ----

struct TestPoints {
  std::vector<double> x, residual, error;
  std::vector<std::string> text;
};

// Standard error of the mean of one test's rows, from the means of its eighths:
// rows next to each other are not independent.
double error_of_mean(Values rows) {
  constexpr std::size_t parts = 8;
  if (rows.size() < parts) return 0;
  std::vector<double> means;
  for (std::size_t i = 0; i < parts; ++i) {
    const std::size_t first = i * rows.size() / parts, end = (i + 1) * rows.size() / parts;
    const Values part = rows.subspan(first, end - first);
    means.push_back(mean_of(part));
  }
  const double middle = mean_of(means);
  double squares = 0;
  for (const double mean : means)
    squares += (mean - middle) * (mean - middle);
  return std::sqrt(squares / (parts * (parts - 1)));
}

TestPoints test_points(const data::Dataset& data, Values x, Values residual) {
  TestPoints points;
  for (std::size_t e = 0; e < data.experiments.size(); ++e) {
    const std::size_t first = data.first_row[e], rows = data.first_row[e + 1] - first;
    const Values r = residual.subspan(first, rows);
    points.x.push_back(mean_of(x.subspan(first, rows)));
    points.residual.push_back(mean_of(r));
    points.error.push_back(error_of_mean(r));
    points.text.push_back(fmt::format("{}: residual {} +- {} MPa at {}", data.experiments[e],
                                      words::figures(points.residual.back()),
                                      words::figures(points.error.back(), 2),
                                      words::short_figures(points.x.back())));
  }
  return points;
}

svg::Axis axis_of(const TestPoints& points) {
  svg::Range range{0, 0};
  for (std::size_t i = 0; i < points.residual.size(); ++i)
    for (const double error : {-points.error[i], points.error[i]})
      range.hold(points.residual[i] + error);
  return svg::nice_axis(range.low, range.high, 5, "mean residual / MPa");
}

std::string tests_plot(const TestPoints& points, const svg::Axis& x_axis, const svg::Axis& y_axis,
                       const std::string& title) {
  svg::Plot plot(plot_width, plot_height, x_axis, y_axis);
  const double ends[] = {x_axis.low, x_axis.high}, zero[] = {0, 0};
  plot.line(ends, zero, {"#222", 1, "", false});
  plot.error_bars(points.x, points.residual, points.error, "#6595c4");
  plot.dots(points.x, points.residual, points.text, points.x.size() > 60 ? 2.5 : 3.5, "#1d5491");
  return plot.text(
      title, "one dot per test, named under the pointer, with the standard error of its mean");
}

// Draws one dot per level, because nothing lies between levels.
void draw_levels_of(const trace::TracedEffect& effect, svg::Plot& plot) {
  const trace::EffectCurve& c = effect.curve;
  const std::vector<std::string> names = effects::level_names(effect.placed);
  std::vector<double> errors;
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < c.factor.size(); ++i) {
    errors.push_back(c.high[i] - c.factor[i]);
    texts.push_back(fmt::format("{}: {} +- {}", names[i], words::figures(c.factor[i]),
                                words::figures(errors.back(), 2)));
  }
  plot.error_bars(c.x, c.factor, errors, "#1d4ed8");
  plot.dots(c.x, c.factor, texts, 5, "#1d4ed8");
}

std::string curve_plot(const trace::TracedEffect& effect, const svg::Axis& x_axis) {
  const trace::EffectCurve& c = effect.curve;
  svg::Range range{1, 1};
  range.hold(c.low);
  range.hold(c.high);
  const double margin = 0.6 * (range.high - range.low);
  const effects::PlacedEffect& placed = effect.placed;
  const std::string what = placed.acts_on == effects::ActsOn::tau
                               ? fmt::format("1 + addition / {:.4g} MPa", placed.tau_scale_MPa)
                               : std::string("factor ") + words::site_text(placed.acts_on);
  const svg::Axis y_axis = svg::nice_axis(range.low - margin, range.high + margin, 5, what);
  svg::Plot plot(plot_width, plot_height, x_axis, y_axis);
  if (!c.point_x.empty()) draw_cloud(plot, c.point_x, c.point_factor, x_axis, y_axis);
  if (placed.form->texts > 0) {
    draw_levels_of(effect, plot);
  } else {
    plot.line(c.x, c.low, {"#1d4ed8", 1, "4 3", true});
    plot.line(c.x, c.high, {"#1d4ed8", 1, "4 3", true});
    plot.line(c.x, c.factor, {"#1d4ed8", 2.5, "", true});
  }
  return plot.text(
      "the effect",
      "its factor with a 95 % band, over partial residuals of the training experiments");
}

// Residual of a law at the tests that judge.
std::vector<double> residuals_of(const ReportInput& input, const calibrate::ModelFit& fit) {
  const auto place = static_cast<std::size_t>(&fit - input.calibration.fits.data());
  return residuals(input.validation.values("tau_R_MPa"), input.predicted[place]);
}

// Draws three plots over the effect's column: residual before, the effect, residual after.
std::string effect_plots(const ReportInput& input, const trace::Trace& trace,
                         const trace::TracedEffect& effect) {
  const calibrate::ModelFit *extended =
                                calibrate::find_fit(input.calibration, trace.extended_model),
                            *own = calibrate::find_fit(input.calibration, trace.model);
  if (!extended || !own) return "";
  const models::AssembledLaw law(extended->model);
  const calibrate::InputColumns columns =
      calibrate::input_columns(law, law.inputs, input.validation);
  const effects::EffectInput& input_of_effect = effect.placed.inputs[0];
  const auto values_of = [&](const effects::EffectInput& one) -> Values {
    return columns[static_cast<std::size_t>(
        std::ranges::find(law.inputs, effects::symbol_of(one.column)) - law.inputs.begin())];
  };
  std::vector<double> pairs; // numbers of pairs of levels of two texts
  Values x = values_of(input_of_effect);
  if (effect.placed.form->texts == 2) {
    const effects::EffectInput& second = effect.placed.inputs[1];
    const Values y = values_of(second);
    for (std::size_t i = 0; i < x.size(); ++i)
      pairs.push_back(static_cast<double>(second.levels.size()) * x[i] + y[i]);
    x = pairs;
  }
  const std::vector<double> r0 = residuals_of(input, *own), r1 = residuals_of(input, *extended);
  const auto [low, high] = std::ranges::minmax_element(x);
  const std::string label = effect.placed.form->texts == 2 ? effects::columns_text(effect.placed)
                                                           : axis_name(input_of_effect.column);
  const svg::Axis x_axis = effect.placed.form->texts > 0
                               ? svg::named_axis(effects::level_names(effect.placed), label)
                               : svg::nice_axis(std::min(*low, input_of_effect.low),
                                                std::max(*high, input_of_effect.high), 5, label);
  const std::string on = ", " + words::judged_words(input.calibration.judged_by).trace;
  const std::string before_title = "residual before" + on, after_title = "residual after" + on;
  if (effect.between) {
    const TestPoints without = test_points(input.validation, x, r0);
    const svg::Axis means = axis_of(without);
    return tests_plot(without, x_axis, means, before_title) + curve_plot(effect, x_axis) +
           tests_plot(test_points(input.validation, x, r1), x_axis, means, after_title);
  }
  std::vector<double> sorted = r0;
  std::ranges::sort(sorted);
  const svg::Axis y_axis =
      svg::nice_axis(quantile(sorted, 0.005), quantile(sorted, 0.995), 5, "residual / MPa");
  return residual_plot({x, r0}, x_axis, y_axis, before_title) + curve_plot(effect, x_axis) +
         residual_plot({x, r1}, x_axis, y_axis, after_title);
}

} // namespace

words::Section traces_with_plots(const ReportInput& input) {
  words::Section section{"trace", "What it lacks", "What the law lacks, by its residual"};
  for (const trace::Trace& trace : input.traces) {
    words::Section one = words::trace(trace, words::Detail::full);
    const std::vector<words::Section*> effects = one.sections(); // before the leads
    for (std::size_t e = 0; e < trace.effects.size(); ++e)
      if (std::string plots = effect_plots(input, trace, trace.effects[e]); !plots.empty())
        effects[e]->add(words::Pictures{"triple", {{std::move(plots)}}});
    if (words::Section smallest = words::detectable_effects(trace); !smallest.blocks.empty()) {
      smallest.foldable = true;
      smallest.open = false;
      one.add(std::move(smallest));
    }
    section.add(std::move(one));
  }
  return section;
}

} // namespace frictab::report
