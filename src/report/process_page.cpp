// Draws a process together with the tests, and the laws in it.
#include "report/process_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "data/quantity.h"
#include "process/coverage.h"
#include "process/smooth.h"
#include "report/page.h"
#include "report/state_plots.h"
#include "report/svg.h"
#include "words/numbers.h"
#include "words/process.h"

namespace frictab::report {

using data::Dataset;
using process::LawThere;
using process::Process;

namespace {

constexpr const char* of_process = "#c2410c";
constexpr const char* of_tests = "#1d5491";
constexpr const char* aside = "#9aa3ad";
constexpr std::size_t points_of_a_line = 121;

// Laws that lead in colours of their own, the others thin and grey.
svg::Stroke law_stroke(const LawThere& law, const process::Assessment& a) {
  constexpr const char* colours[] = {"#c2410c", "#1d5491", "#0f766e", "#7e22ce", "#a16207"};
  constexpr const char* dashes[] = {"", "7 3", "2 3"};
  if (!law.leads) return {aside, 1.1, law.candidate ? "2 3" : "6 3", true};
  std::size_t place = 0;
  for (const LawThere* other = a.laws.data(); other != &law; ++other)
    place += other->leads;
  return {colours[place % std::size(colours)], 2,
          dashes[place / std::size(colours) % std::size(dashes)], true};
}

// ---- the laws over the contact normal stress ----

// Rows at these pressures, each a test of its own, all else at the middle of the friction work.
Dataset rows_over(const Process& p, std::span<const double> pressures) {
  Dataset rows;
  for (const data::Column& column : p.history.states.columns) {
    const double middle = column.levels.empty()
                              ? process::weighted_quantile(column.values, p.work_J, 0.5)
                              : column.values.front();
    data::Column out = column;
    out.values.assign(pressures.size(), middle);
    if (column.name == "sigma_n_MPa") out.values.assign(pressures.begin(), pressures.end());
    rows.columns.push_back(std::move(out));
  }
  for (std::size_t i = 1; i <= pressures.size(); ++i) {
    rows.first_row.push_back(i);
    rows.experiments.push_back(std::to_string(i));
  }
  return rows;
}

// A histogram as a line of steps, `height` at its highest.
void draw_histogram(svg::Plot& plot, std::span<const double> values,
                    std::span<const double> weights, const svg::Axis& axis, double height,
                    const svg::Stroke& stroke) {
  constexpr std::size_t bins = 40;
  std::vector<double> sums(bins);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double at = (values[i] - axis.low) / (axis.high - axis.low) * bins;
    if (at >= 0 && at < bins) sums[static_cast<std::size_t>(at)] += weights[i];
  }
  const double most = *std::ranges::max_element(sums);
  if (!(most > 0)) return;
  std::vector<double> x, y;
  for (std::size_t b = 0; b < bins; ++b)
    for (const std::size_t edge : {b, b + 1}) {
      x.push_back(axis.low + (axis.high - axis.low) * static_cast<double>(edge) / bins);
      y.push_back(height * sums[b] / most);
    }
  plot.line(x, y, stroke);
}

words::Picture laws_picture(const Process& p, const Dataset& tests,
                            const calibrate::Calibration& calibration) {
  const auto pressure = p.history.states.values("sigma_n_MPa");
  const auto of_tests_range = span_of(tests.values("sigma_n_MPa")).value_or(std::pair(0.0, 1.0));
  const double low = std::min(process::weighted_quantile(pressure, p.work_J, 0.01),
                              of_tests_range.first),
               high = std::max(process::weighted_quantile(pressure, p.work_J, 0.99),
                               of_tests_range.second);
  std::vector<double> x;
  for (std::size_t i = 0; i < points_of_a_line; ++i)
    x.push_back(low + (high - low) * static_cast<double>(i) / (points_of_a_line - 1));
  const Dataset rows = rows_over(p, x);
  const process::Assessment& a = p.latest();
  std::vector<std::vector<double>> lines;
  double most = 0;
  for (const LawThere& law : a.laws) {
    lines.push_back(
        calibrate::predict(calibrate::find_fit(calibration, law.law)->delivered().model, rows));
    if (law.leads) most = std::max(most, *std::ranges::max_element(lines.back()));
  }
  const svg::Axis x_axis = svg::nice_axis(low, high, 6, axis_name("sigma_n_MPa")),
                  y_axis = svg::nice_axis(0, 1.15 * most, 6, axis_name("tau_R_MPa"));
  svg::Plot plot(620, 320, x_axis, y_axis);
  draw_histogram(plot, pressure, p.work_J, x_axis, 0.3 * y_axis.high, {of_process, 1.4, "", true});
  const auto of_rows = tests.values("sigma_n_MPa");
  draw_histogram(plot, of_rows, std::vector<double>(of_rows.size(), 1.0), x_axis, 0.3 * y_axis.high,
                 {of_tests, 1.4, "1 2", true});
  std::vector<svg::EndLabel> names;
  for (std::size_t l = a.laws.size(); l-- > 0;) {
    plot.line(x, lines[l], law_stroke(a.laws[l], a));
    if (a.laws[l].leads)
      names.push_back({std::clamp(lines[l].back(), y_axis.low, y_axis.high), a.laws[l].law,
                       law_stroke(a.laws[l], a).colour});
  }
  plot.labels_beside(x.back(), names);
  return {plot.text("laws over contact normal stress at the middle of the process",
                    "Lines: laws; steps: friction work of the process, and rows of the tests"),
          {}};
}

// ---- maps ----

svg::Axis axis_of(const std::string& state, double low, double high, int ticks) {
  const bool log = data::find_quantity(state)->log_axis && low > 0 && high > 4 * low;
  return log ? svg::log_axis(low, high, axis_name(state))
             : svg::nice_axis(low, high, ticks, axis_name(state));
}

std::vector<double> on_axis(std::span<const double> values, const svg::Axis& axis) {
  std::vector<double> out(values.begin(), values.end());
  if (axis.log)
    for (double& x : out)
      x = std::log(x);
  return out;
}

// Range of the process (all but 1 % of its friction work) and the tests together.
std::pair<double, double> shared_range(const process::StateCoverage& s) {
  return {std::min(s.low, s.tested_low), std::max(s.high, s.tested_high)};
}

words::Picture map_picture(const Process& p, const Dataset& tests,
                           const process::StateCoverage& x_state,
                           const process::StateCoverage& y_state) {
  const auto [x_low, x_high] = shared_range(x_state);
  const auto [y_low, y_high] = shared_range(y_state);
  const svg::Axis x_axis = axis_of(x_state.state, x_low, x_high, 5),
                  y_axis = axis_of(y_state.state, y_low, y_high, 5);
  svg::Plot plot(300, 200, x_axis, y_axis);
  constexpr std::size_t nx = 60, ny = 40;
  // Counts of 10,000: each contact as often as its share of the friction work.
  const std::vector<double> x = on_axis(p.history.states.values(x_state.state), x_axis),
                            y = on_axis(p.history.states.values(y_state.state), y_axis);
  const double all = std::accumulate(p.work_J.begin(), p.work_J.end(), 0.0);
  std::vector<double> sums(nx * ny);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double column = (x[i] - x_axis.low) / (x_axis.high - x_axis.low) * nx,
                 row = (y_axis.high - y[i]) / (y_axis.high - y_axis.low) * ny;
    if (column >= 0 && column < nx && row >= 0 && row < ny)
      sums[static_cast<std::size_t>(row) * nx + static_cast<std::size_t>(column)] += p.work_J[i];
  }
  svg::Density density{nx, ny, {}, 0};
  std::uint32_t largest = 1;
  for (const double sum : sums) {
    density.counts.push_back(static_cast<std::uint32_t>(std::lround(1e4 * sum / all)));
    largest = std::max(largest, density.counts.back());
  }
  plot.density(density, svg::count_classes(largest, 7));
  constexpr std::size_t dots_of_a_test = 6;
  std::vector<double> dots_x, dots_y;
  std::vector<std::string> names;
  const std::vector<double> of_x = on_axis(tests.values(x_state.state), x_axis),
                            of_y = on_axis(tests.values(y_state.state), y_axis);
  for (std::size_t e = 0; e < tests.experiments.size(); ++e)
    for (const std::size_t row :
         process::some_rows(tests.first_row[e], tests.first_row[e + 1], dots_of_a_test)) {
      dots_x.push_back(of_x[row]);
      dots_y.push_back(of_y[row]);
      names.push_back(tests.experiments[e]);
    }
  plot.dots(dots_x, dots_y, names, 1.6, of_process, true);
  return {plot.text(fmt::format("friction work over {} and {}", x_state.state, y_state.state),
                    "Shades: friction work; rings: rows of the tests"),
          y_state.state};
}

words::Section where(const Process& p, const Dataset& tests) {
  words::Section section = words::process_coverage(p);
  const auto& states = p.coverage.states;
  if (states.size() < 2) return section;
  words::Pictures maps{"panels"};
  for (std::size_t s = 1; s < states.size(); ++s)
    maps.pictures.push_back(map_picture(p, tests, states[0], states[s]));
  section.say("Shades: friction work of the process; rings: a few rows of each test, named under "
              "the pointer.");
  section.add(std::move(maps));
  return section;
}

// ---- forces ----

words::Picture force_picture(const Process& p) {
  const process::Tool& tool = *p.history.tool;
  const bool by_stroke = !tool.stroke_mm.empty();
  const std::vector<double>& x = by_stroke ? tool.stroke_mm : p.history.time_s;
  double most = *std::ranges::max_element(tool.force_kN);
  const process::Assessment& a = p.latest();
  for (const LawThere& law : a.laws)
    if (law.leads) most = std::max(most, *std::ranges::max_element(law.force_kN));
  const svg::Axis x_axis =
      svg::nice_axis(0, *std::ranges::max_element(x), 6, by_stroke ? "stroke / mm" : "t / s");
  const svg::Axis y_axis = svg::nice_axis(0, most, 5, "force / kN");
  svg::Plot plot(340, 220, x_axis, y_axis);
  std::vector<svg::EndLabel> names;
  for (const LawThere& law : a.laws) {
    plot.line(x, law.force_kN, law_stroke(law, a));
    if (law.leads)
      names.push_back({std::clamp(law.force_kN.back(), y_axis.low, y_axis.high), law.law,
                       law_stroke(law, a).colour});
  }
  plot.line(x, tool.force_kN, {"#111", 2.2, "", true});
  names.push_back({std::clamp(tool.force_kN.back(), y_axis.low, y_axis.high), "yours", "#111"});
  plot.labels_beside(x.back(), names);
  return {plot.text("force over the stroke by laws", "One line per law; black: the simulation"),
          "Force, by the laws that lead; others grey; black: your simulation"};
}

words::Picture change_picture(const Process& p) {
  const process::Assessment& a = p.latest();
  std::vector<std::string> names;
  std::vector<double> x, y, middle, error;
  std::vector<std::string> text;
  double low = 0, high = 0;
  for (const LawThere& law : a.laws) {
    if (!law.candidate) continue;
    x.push_back(static_cast<double>(names.size()));
    const stats::Interval range = process::shown_range(law.late_percent);
    y.push_back(law.late_percent);
    middle.push_back(0.5 * (range.low + range.high));
    error.push_back(0.5 * (range.high - range.low));
    text.push_back(law.law + ": " + words::change_text(p, law.late_percent));
    names.push_back(law.law);
    if (!law.leads && !law.may_be_best) continue;
    low = std::min(low, range.low);
    high = std::max(high, range.high);
  }
  const svg::Axis y_axis = svg::nice_axis(low, high, 5, "change of force / %");
  const svg::Axis x_axis = svg::named_axis(names, "");
  svg::Plot plot(340, 200, x_axis, y_axis);
  plot.line(std::vector{x_axis.low, x_axis.high}, std::vector{0.0, 0.0}, {"#6b7580", 1, "", false});
  plot.error_bars(x, middle, error, aside);
  plot.dots(x, y, text, 4, of_process);
  return {
      plot.text("change of force by law", "One dot per law, with the range that reruns stay in"),
      "Change of the mean force over the late half, with the range that reruns stay in; laws "
      "beyond the axis lie further"};
}

words::Section said(const Process& p) {
  words::Section section = words::process_laws(p);
  if (p.prediction != process::Prediction::force) return section;
  section.add(words::Pictures{"panels", {force_picture(p), change_picture(p)}});
  return section;
}

words::Section overview(const Process& p, const Dataset& tests,
                        const calibrate::Calibration& calibration) {
  words::Section section{"overview", "Laws and work", "The laws where the process rubs"};
  section.say("Lines: " + words::symbol("tau_R") + " of each law over " + words::symbol("sigma_N") +
              " at the middle of the process's friction work; laws that lead in colour, the others "
              "grey. Steps: friction work of the process (solid) and rows of the tests (dotted), "
              "each to its own scale.");
  section.add(words::Pictures{"scroll wide", {laws_picture(p, tests, calibration)}});
  return section;
}

} // namespace

std::string process_html(const Process& p, const Dataset& tests,
                         const calibrate::Calibration& calibration, const std::string& job) {
  const std::vector<std::string>& files = p.history.states.sources;
  const std::string name = files.empty() ? job : files.front();
  Page page{std::filesystem::path(name).filename().string(),
            "The laws in your process",
            {},
            words::process_in_short(p),
            {overview(p, tests, calibration), where(p, tests), said(p), words::process_tests(p),
             words::process_reading(p)}};
  if (p.synthetic) page.warnings.push_back(synthetic_warning());
  return html_of(page);
}

} // namespace frictab::report
