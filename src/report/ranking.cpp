// Adds bars to the ranking; draws each law against the measurement.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "calibrate/recommended.h"
#include "report/formula.h"
#include "report/law_plots.h"
#include "report/sections.h"
#include "report/state_plots.h"
#include "words/judged.h"
#include "words/laws.h"
#include "words/numbers.h"
#include "words/published.h"

namespace frictab::report {

using models::Calibrated;

namespace {

constexpr double bar_width = 220, bar_height = 22;

std::string kind_text(const models::Law& law) {
  switch (law.calibrated) {
  case Calibrated::fixed:
    return "literature, fixed";
  case Calibrated::mean:
    return "means of the training data";
  case Calibrated::fit:
    return "fitted";
  case Calibrated::train:
    return "trained";
  case Calibrated::regress:
    return "fitted, with its formula";
  }
  return "";
}

std::string bar_colour(const models::Law& law) {
  if (law.calibrated == Calibrated::fixed) return "#7f8a96";
  return law.calibrated == Calibrated::mean ? "#6595c4" : "#2f6ea6";
}

// Fixed constants may be many times worse than the rest; laws beyond four times the best do not
// stretch the axis, and their bars are cut.
svg::Axis bar_axis(const calibrate::Calibration& calibration) {
  const double best = calibrate::best_fit(calibration).validation.mae_MPa;
  double high = best;
  for (const calibrate::ModelFit& fit : calibration.fits) {
    const calibrate::Metrics& v = fit.validation;
    const double end = std::isfinite(v.mae_interval.high) ? v.mae_interval.high : v.mae_MPa;
    if (!(v.mae_MPa > 4 * best)) high = std::max(high, end);
  }
  if (!std::isfinite(high) || high <= 0) high = 1;
  return svg::nice_axis(0, high, 5, "MPa");
}

words::Cell bar_cell(double mae, const calibrate::Interval& interval, double best,
                     const std::string& colour, const std::string& name, const svg::Axis& axis) {
  words::Cell cell;
  cell.picture =
      svg::bar({mae, interval.low, interval.high, best, colour,
                fmt::format("{}: {} MPa, 95 % interval {} to {} MPa", name, words::figures(mae),
                            words::figures(interval.low), words::figures(interval.high))},
               axis, bar_width, bar_height);
  return cell;
}

bool has_plots(const ReportInput& input) {
  return input.validation.has("tau_R_MPa") && input.validation.rows() > 0 &&
         input.predicted.size() == input.calibration.fits.size() && !input.predicted.empty();
}

} // namespace

words::Section ranking_with_bars(const ReportInput& input) {
  const calibrate::Calibration& c = input.calibration;
  words::Section section = words::ranking(c);
  if (c.fits.empty()) return section;
  words::Table& table = section.table();
  constexpr std::size_t law_column = 1, bar_column = 4; // after the interval
  const svg::Axis axis = bar_axis(c);
  const double best = calibrate::best_fit(c).validation.mae_MPa;
  words::Column bars{"MAE", false, "", words::Shown::in_html, "bars"};
  bars.picture = svg::bar_scale(axis, bar_width, bar_height);
  table.columns.insert(table.columns.begin() + bar_column, std::move(bars));
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    std::vector<words::Cell>& cells = table.rows[i].cells;
    if (i == c.fits.size()) {
      const calibrate::NoiseFloor& floor = c.noise_floors.front();
      cells.insert(cells.begin() + bar_column, bar_cell(floor.mae_MPa, floor.mae_interval, best,
                                                        "#9c9268", "noise floor", axis));
      continue;
    }
    const models::Law& law = *c.fits[i].model.law;
    const calibrate::Metrics& v = c.fits[i].validation;
    words::Cell& name = cells[law_column];
    name.note = kind_text(law) + (name.note.empty() ? "" : "; " + name.note);
    if (has_plots(input)) name.text = words::link(law.name, "#law-" + law.name);
    cells.insert(cells.begin() + bar_column,
                 bar_cell(v.mae_MPa, v.mae_interval, best, bar_colour(law), law.name, axis));
  }
  return section;
}

static words::Section law_against_measurement(const ReportInput& input, std::size_t i,
                                              const PlotFrame& frame) {
  const calibrate::ModelFit& fit = input.calibration.fits[i];
  const models::Law& law = *fit.model.law;
  const LawPlots plots = law_plots(input, i, frame);
  words::Section section{
      "law-" + law.name, "",
      fmt::format("{}. {}: {} MPa", i + 1, law.name,
                  words::fixed(fit.validation.mae_MPa, words::error_decimals(input.calibration)))};
  section.foldable = true;
  section.open = i == 0;
  section.say(law.title + ".");
  section.add(words::Pictures{"scroll formula", {{formula_html(fit.model)}}});
  section.add(words::Pictures{"pair", {{plots.predicted}, {plots.residual}}});
  section.say(plots.note, "small");
  // Errors of constants of the literature do not depend on a single state.
  if (words::kind_of(law) != words::LawKind::literature)
    if (std::string states = residuals_over_states(input, i, frame); !states.empty())
      section.add(words::Pictures{"states", {{std::move(states)}}});
  return section;
}

words::Section each_law(const ReportInput& input) {
  words::Section section{"plots", "Plots", "Each law against the measurement"};
  if (!has_plots(input)) {
    section.say("There are no predictions to show.");
    return section;
  }
  const PlotFrame frame = plot_frame(input);
  section.say(words::judged_words(input.calibration.judged_by).plotted +
              ". The same axes and colours for all laws. Left: a good law follows the line. Right, "
              "and below over each input (not for constants of the literature): a good law leaves "
              "a narrow band around zero, without trend. At the right edge: the probability "
              "density of the residual, on one scale for all laws. Residuals stand over the "
              "prediction and the states, not over the measurement: its noise alone would tilt "
              "every law. The residual axis holds 99 % of the rows of each calibrated law. Rows "
              "are counted in cells; each point of the running lines stands for at least 20 rows.");
  section.add(words::Pictures{"legends", {{plot_legend(frame)}}});
  for (std::size_t i = 0; i < input.calibration.fits.size(); ++i)
    section.add(law_against_measurement(input, i, frame));
  return section;
}

} // namespace frictab::report
