// Draws laws as lines over the contact normal stress, with the rows they are
// judged by: all laws in one plot, then the best one by each of its inputs.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "calibrate/input_columns.h"
#include "calibrate/recommended.h"
#include "data/quantity.h"
#include "expr/program.h"
#include "report/sections.h"
#include "report/state_plots.h"
#include "report/svg.h"
#include "words/numbers.h"
#include "words/published.h"

namespace frictab::report {

namespace {

constexpr const char* abscissa_name = "sigma_n_MPa";
constexpr std::size_t line_points = 60;

// Inputs of a law in the data, and the level of each that is not drawn.
struct DrawnLaw {
  models::AssembledLaw law;
  expr::Program program;
  std::vector<std::vector<double>> sorted; // finite values per input
  std::size_t sigma = 0;                   // index of the normal stress among the inputs; their
                                           // number: none of them
};

std::optional<DrawnLaw> drawn_law(const ReportInput& input, const calibrate::ModelFit& fit) {
  models::AssembledLaw law(fit.model);
  const auto at = std::ranges::find(law.inputs, abscissa_name);
  if (!calibrate::missing_inputs(law.inputs, input.validation).empty()) return std::nullopt;
  const auto sigma = static_cast<std::size_t>(at - law.inputs.begin());
  const calibrate::InputColumns columns =
      calibrate::input_columns(law, law.inputs, input.validation);
  std::vector<std::vector<double>> sorted = columns.values();
  for (std::vector<double>& values : sorted) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    if (values.empty()) return std::nullopt;
    std::ranges::sort(values);
  }
  expr::Program program(law.in_numbers(law.tau_R), law.inputs, {});
  return DrawnLaw{std::move(law), std::move(program), std::move(sorted), sigma};
}

// Evaluates tau_R over `x`, with input `other` at its quantile `share` and all others at their
// medians.
std::vector<double> tau_over(const DrawnLaw& drawn, const std::vector<double>& x, std::size_t other,
                             double share) {
  std::vector<double> row, tau;
  for (std::size_t i = 0; i < drawn.sorted.size(); ++i)
    row.push_back(quantile(drawn.sorted[i], i == other ? share : 0.5));
  for (const double sigma : x) {
    if (drawn.sigma < row.size()) row[drawn.sigma] = sigma;
    tau.push_back(drawn.program(row, {}));
  }
  return tau;
}

void draw_rows(svg::Plot& plot, const ReportInput& input, const svg::Axis& x, const svg::Axis& y) {
  const svg::Density cells = svg::bin(input.validation.values(abscissa_name),
                                      input.validation.values("tau_R_MPa"), x, y, 68, 40);
  const std::uint32_t most = *std::ranges::max_element(cells.counts);
  plot.density(cells, svg::count_classes(std::max<std::uint32_t>(most, 1), 4));
}

// Draws the 5 % and 95 % factors of experiments around the median line.
void draw_band(svg::Plot& plot, const calibrate::BandCheck& band, const std::vector<double>& x,
               const std::vector<double>& tau) {
  for (const std::optional<double>& factor : {band.low, band.high}) {
    if (!factor) continue;
    std::vector<double> y = tau;
    for (double& value : y)
      value *= *factor;
    plot.line(x, y, {"#111", 1.2, "2 3", true});
  }
}

struct Level {
  double share; // share of the rows below the level
  const char* colour;
  const char* dash;
  std::string value; // as text
  std::vector<double> tau;
};

std::vector<Level> levels_of(const DrawnLaw& drawn, const std::vector<double>& x,
                             std::size_t other) {
  std::vector<Level> levels = {{0.1, "#0f766e", "7 3", "", {}},
                               {0.5, "#c2410c", "", "", {}},
                               {0.9, "#7e22ce", "1 3", "", {}}};
  for (Level& level : levels) {
    level.value = words::short_figures(quantile(drawn.sorted[other], level.share), 3);
    level.tau = tau_over(drawn, x, other, level.share);
  }
  return levels;
}

// Part of the caption on the lines: "409, 432 and 454 (10, 50 and 90 % of the rows lie below)".
std::string described(const std::vector<Level>& levels) {
  if (levels.front().value == levels.back().value)
    return levels.front().value + " (10 to 90 % of the rows)";
  return fmt::format("{}, {} and {} (10, 50 and 90 % of the rows lie below)", levels[0].value,
                     levels[1].value, levels[2].value);
}

double largest_difference(const std::vector<Level>& levels) {
  double largest = 0;
  for (std::size_t i = 0; i < levels[0].tau.size(); ++i)
    largest = std::max({largest, std::abs(levels[0].tau[i] - levels[1].tau[i]),
                        std::abs(levels[2].tau[i] - levels[1].tau[i])});
  return largest;
}

// Draws the median line, and the others where they are visibly different from it. Returns the
// caption's remark on those that are not.
std::string draw_levels(svg::Plot& plot, const std::vector<Level>& levels,
                        const std::vector<double>& x) {
  const Level &low = levels[0], &median = levels[1], &high = levels[2];
  const bool at_low = plot.one_line(low.tau, median.tau),
             at_high = plot.one_line(high.tau, median.tau);
  std::vector<svg::EndLabel> names;
  for (const Level* level : {&low, &high, &median}) {
    if ((level == &low && at_low) || (level == &high && at_high)) continue;
    std::string name = level->value;
    if (level == &median && low.value != high.value && (at_low || at_high))
      name = (at_low ? low : median).value + " to " + (at_high ? high : median).value;
    plot.line(x, level->tau, {level->colour, 2.2, level->dash, true});
    names.push_back({level->tau.back(), name, level->colour});
  }
  plot.labels_beside(x.back(), names);
  if (low.value == high.value || !(at_low || at_high)) return "";
  if (at_low && at_high)
    return fmt::format(": one line, the law differs by {} MPa at most",
                       words::figures(largest_difference(levels), 2));
  return fmt::format(": {} and {} are one line", (at_low ? low : median).value,
                     (at_low ? median : high).value);
}

std::vector<double> evenly(std::pair<double, double> range) {
  std::vector<double> x;
  for (std::size_t i = 0; i < line_points; ++i)
    x.push_back(range.first + (range.second - range.first) * static_cast<double>(i) /
                                  static_cast<double>(line_points - 1));
  return x;
}

words::Picture panel(const ReportInput& input, const DrawnLaw& drawn, std::size_t other,
                     const svg::Axis& x_axis, const svg::Axis& y_axis) {
  const auto& sigma = drawn.sorted[drawn.sigma];
  const std::vector<double> x = evenly({sigma.front(), sigma.back()});
  svg::Plot plot(340, 200, x_axis, y_axis);
  draw_rows(plot, input, x_axis, y_axis);
  const std::vector<Level> levels = levels_of(drawn, x, other);
  draw_band(plot, calibrate::best_fit(input.calibration).band, x, levels[1].tau);
  std::string what = "sigma_n_MPa alone", lines;
  if (other == drawn.sigma) {
    plot.line(x, levels[1].tau, {levels[1].colour, 2.2, "", true});
  } else {
    what = drawn.law.inputs[other];
    lines = " at " + described(levels) + draw_levels(plot, levels, x);
  }
  return {plot.text(drawn.law.model.law->name + " over contact normal stress, by " + what,
                    "Lines" + lines + "; dotted: the band of experiments"),
          what + lines};
}

// ---- all laws ----

struct LawLine {
  std::vector<double> tau;
  std::string names; // of all laws that this line stands for
  svg::Stroke stroke;
};

// Constants of the literature are grey and thin; the best law is thick.
svg::Stroke line_style(const models::Law& law, std::size_t place) {
  constexpr const char* colours[] = {"#c2410c", "#1d5491", "#0f766e", "#7e22ce",
                                     "#a16207", "#be185d", "#4d7c0f", "#0e7490"};
  constexpr const char* dashes[] = {"", "7 3", "2 3"};
  if (words::kind_of(law) == words::LawKind::literature) return {"#6b7580", 1.2, "4 3", true};
  return {colours[place % std::size(colours)], place == 0 ? 2.6 : 1.5,
          dashes[place / std::size(colours) % std::size(dashes)], true};
}

// A law whose line coincides with one that is drawn already adds its name to that.
void add_line(std::vector<LawLine>& lines, const svg::Plot& plot, LawLine line) {
  for (LawLine& drawn : lines)
    if (plot.one_line(drawn.tau, line.tau)) {
      drawn.names += ", " + line.names;
      return;
    }
  lines.push_back(std::move(line));
}

words::Picture all_laws_picture(const ReportInput& input, std::pair<double, double> sigma,
                                const svg::Axis& x_axis, const svg::Axis& y_axis) {
  svg::Plot plot(620, 320, x_axis, y_axis);
  draw_rows(plot, input, x_axis, y_axis);
  const std::vector<double> x = evenly(sigma);
  std::vector<LawLine> lines;
  const auto& fits = input.calibration.fits;
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (const auto drawn = drawn_law(input, fits[i]))
      add_line(lines, plot,
               {tau_over(*drawn, x, drawn->sigma, 0.5), fits[i].model.law->name,
                line_style(*fits[i].model.law, i)});
  std::vector<svg::EndLabel> names;
  for (std::size_t i = lines.size(); i-- > 0;) { // the best on top
    plot.line(x, lines[i].tau, lines[i].stroke);
    names.push_back({std::clamp(lines[i].tau.back(), y_axis.low, y_axis.high), lines[i].names,
                     lines[i].stroke.colour});
  }
  plot.labels_beside(x.back(), names);
  return {plot.text("all laws over contact normal stress, with the data",
                    "One line per law at the medians of its other inputs; shades: rows"),
          {}};
}

// Ranges of the rows that are drawn, which both plots share.
struct DrawnRows {
  std::pair<double, double> sigma, tau;

  svg::Axis x(int ticks) const {
    return svg::nice_axis(sigma.first, sigma.second, ticks, axis_name(abscissa_name));
  }
  svg::Axis y(int ticks) const {
    return svg::nice_axis(std::min(0.0, tau.first), tau.second, ticks, axis_name("tau_R_MPa"));
  }
};

// Nothing without laws, rows, or a range of either quantity.
std::optional<DrawnRows> drawn_rows(const ReportInput& input) {
  const data::Dataset& data = input.validation;
  if (input.calibration.fits.empty() || !data.has(abscissa_name) || !data.has("tau_R_MPa") ||
      data.rows() == 0)
    return std::nullopt;
  const auto sigma = span_of(data.values(abscissa_name)), tau = span_of(data.values("tau_R_MPa"));
  if (!sigma || !tau) return std::nullopt;
  return DrawnRows{*sigma, *tau};
}

} // namespace

words::Section all_laws_with_data(const ReportInput& input) {
  words::Section section{"laws", "All laws", {}};
  const auto rows = drawn_rows(input);
  if (!rows) return section;
  section.title = "All laws over the contact normal stress, with the data";
  section.say("Lines: " + words::symbol("tau_R") + " of each law over " + words::symbol("sigma_N") +
              " at the medians of its other inputs; constants of the literature in grey; laws on "
              "one line share it. Shades: all rows the laws are judged by, at all values of their "
              "inputs. Other states, maps and single tests: " +
              words::link("explore.html", "./explore.html") + ".");
  section.add(words::Pictures{"scroll wide",
                              {all_laws_picture(input, rows->sigma, rows->x(6), rows->y(6))}});
  return section;
}

words::Section best_law_with_data(const ReportInput& input) {
  words::Section section{"law", "The law", {}};
  const auto rows = drawn_rows(input);
  if (!rows) return section;
  const auto drawn = drawn_law(input, calibrate::best_fit(input.calibration));
  if (!drawn || drawn->sigma == drawn->sorted.size()) return section;
  section.title = "The law with the data: " + drawn->law.model.law->name;
  section.say(words::symbol("tau_R") + " over " + words::symbol("sigma_N") +
              ", one plot for each other input of the law. Lines: the law with that input low "
              "(dashed), at its median (solid) and high (dotted), the remaining inputs at their "
              "medians; lines that coincide are drawn once. Thin dotted lines: the band in which "
              "90 % of new experiments are expected, around the median. Shades: all rows the law "
              "was judged by, at all values of their inputs.");
  const svg::Axis x = rows->x(5), y = rows->y(5);
  words::Pictures panels{"panels"};
  for (std::size_t i = 0; i < drawn->sorted.size(); ++i)
    if (i != drawn->sigma && drawn->sorted[i].front() < drawn->sorted[i].back())
      panels.pictures.push_back(panel(input, *drawn, i, x, y));
  if (panels.pictures.empty()) panels.pictures.push_back(panel(input, *drawn, drawn->sigma, x, y));
  section.add(std::move(panels));
  return section;
}

} // namespace frictab::report
