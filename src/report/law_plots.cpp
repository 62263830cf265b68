// Measured, predicted and residual shear stress as binned densities.
#include "report/law_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/text.h"
#include "report/number.h"

namespace frictab {

namespace {

constexpr std::size_t columns = 96, rows = 64, square = 64; // cells of about 5 pixels
constexpr std::size_t quantile_bins = 28, fewest_rows = 8;  // of the running median

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(const Range& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
  }
};

double quantile(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

// All values, unless a few far ones would make the rest a line: then 99.8 % of them.
Range range_of(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  Range all;
  if (values.empty()) return all;
  for (const double v : values)
    all.add({v, v});
  const Range most{quantile(values, 0.001), quantile(values, 0.999)};
  const double span = most.high - most.low;
  const bool far = span > 0 && all.high - all.low > 2.5 * span;
  return far ? Range{most.low - 0.1 * span, most.high + 0.1 * span} : all;
}

std::vector<double> residuals(std::span<const double> measured,
                              const std::vector<double>& predicted) {
  std::vector<double> residual(measured.size());
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] = measured[i] - predicted[i];
  return residual;
}

struct Quantiles {
  svg::Points low, median, high;
};

// Runs of neighbouring bins of x with enough rows; a gap ends a run.
std::vector<Quantiles> running_quantiles(std::span<const double> x, std::span<const double> y,
                                         const svg::Axis& axis) {
  std::vector<std::vector<double>> parts(quantile_bins);
  const double width = (axis.high - axis.low) / static_cast<double>(quantile_bins);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(y[i]) && x[i] >= axis.low && x[i] <= axis.high)
      parts[std::min(quantile_bins - 1, static_cast<std::size_t>((x[i] - axis.low) / width))]
          .push_back(y[i]);
  std::vector<Quantiles> runs(1);
  for (std::size_t b = 0; b < quantile_bins; ++b) {
    if (parts[b].size() < fewest_rows) {
      if (!runs.back().median.empty()) runs.emplace_back();
      continue;
    }
    const double centre = axis.low + (static_cast<double>(b) + 0.5) * width;
    runs.back().low.emplace_back(centre, quantile(parts[b], 0.1));
    runs.back().median.emplace_back(centre, quantile(parts[b], 0.5));
    runs.back().high.emplace_back(centre, quantile(parts[b], 0.9));
  }
  return runs;
}

struct Sheet {
  svg::Axis predicted, measured, residual;
  std::vector<std::uint32_t> steps;
};

struct Densities {
  svg::Density agreement, residual;
};

std::string agreement_plot(const Sheet& sheet, const Densities& densities, const std::string& name,
                           std::size_t n) {
  svg::Plot plot(sheet.predicted, sheet.measured, {396, 380, 66, 12, 12, 50});
  plot.density(densities.agreement, sheet.steps);
  const svg::Axis& axis = sheet.measured;
  plot.line({{axis.low, axis.low}, {axis.high, axis.high}}, "one");
  return plot.text(name + ": measured against predicted tau_R",
                   "Density of " + thousands(n) + " rows with the line of equality.");
}

std::string residual_plot(const Sheet& sheet, const Densities& densities, const std::string& name,
                          std::span<const double> measured, std::span<const double> residual) {
  svg::Plot plot(sheet.measured, sheet.residual, {560, 380, 66, 12, 12, 50});
  plot.density(densities.residual, sheet.steps);
  plot.line({{sheet.measured.low, 0}, {sheet.measured.high, 0}}, "zero");
  const auto runs = running_quantiles(measured, residual, sheet.measured);
  for (const Quantiles& run : runs) {
    plot.line(run.low, "band");
    plot.line(run.high, "band");
  }
  for (const Quantiles& run : runs) {
    plot.line(run.median, "halo");
    plot.line(run.median, "median");
  }
  return plot.text(name + ": residual against measured tau_R",
                   "Density of " + thousands(measured.size()) +
                       " rows with running median and 10 to 90 percent band.");
}

std::string swatch(double x, std::size_t colour, const std::string& text) {
  return fmt::format("<rect class=\"d{} edge\" x=\"{}\" y=\"8\" width=\"16\" height=\"16\"/>"
                     "<text class=\"tick\" x=\"{}\" y=\"20\">{}</text>",
                     colour, svg::pixel(x), svg::pixel(x + 21), svg::escape(text));
}

std::string key(double x, std::string_view css_class, std::string_view text) {
  return fmt::format("<path class=\"{}\" d=\"M{} 40h28\"/>"
                     "<text class=\"tick\" x=\"{}\" y=\"44\">{}</text>",
                     css_class, svg::pixel(x), svg::pixel(x + 35), svg::escape(text));
}

std::string legend(std::span<const std::uint32_t> steps) {
  std::string marks = "<text class=\"axis\" x=\"0\" y=\"20\">rows per cell</text>";
  double x = 96;
  for (std::size_t c = 0; c < steps.size(); ++c) {
    const std::size_t from = steps[c];
    std::string text = thousands(from);
    if (c + 1 == steps.size())
      text += from > 1 || c > 0 ? " or more" : "";
    else if (steps[c + 1] > from + 1)
      text += "\u2013" + thousands(steps[c + 1] - 1);
    marks += swatch(x, c, text);
    x += 44 + 7.2 * static_cast<double>(text.size() - (text.find("\u2013") != text.npos ? 2 : 0));
  }
  marks += key(0, "one", "measured = predicted") + key(200, "zero", "no residual") +
           key(340, "median", "running median") + key(500, "band", "10 and 90 % of the rows");
  return "<svg class=\"legend\" role=\"img\" viewBox=\"0 0 960 52\" aria-label=\"Legend: darker "
         "cells hold more rows\"><title>Legend: darker cells hold more rows</title>" +
         marks + "</svg>";
}

std::string outside_text(const Densities& densities, std::size_t n) {
  std::string text;
  if (densities.agreement.outside)
    text += fmt::format("{} of {} rows lie beyond the axes of the left plot. ",
                        thousands(densities.agreement.outside), thousands(n));
  if (densities.residual.outside)
    text += fmt::format("{} of {} rows lie beyond the axes of the right plot. ",
                        thousands(densities.residual.outside), thousands(n));
  if (!text.empty()) text.pop_back();
  return text;
}

Sheet shared_axes(std::span<const double> measured,
                  const std::vector<std::vector<double>>& predicted) {
  const Range meas = range_of({measured.begin(), measured.end()});
  Range both = meas, residual{0, 0};
  both.add({0, 0});
  for (const auto& p : predicted) {
    both.add(range_of(p));
    residual.add(range_of(residuals(measured, p)));
  }
  Sheet sheet;
  sheet.measured = svg::nice_axis(both.low, both.high, "measured tau_R, MPa");
  sheet.predicted = svg::nice_axis(both.low, both.high, "predicted tau_R, MPa");
  sheet.residual = svg::nice_axis(residual.low, residual.high, "measured \u2212 predicted, MPa", 8);
  return sheet;
}

} // namespace

PlotSheet law_plots(std::span<const double> measured,
                    const std::vector<std::vector<double>>& predicted,
                    const std::vector<std::string>& names) {
  Sheet sheet = shared_axes(measured, predicted);
  std::vector<Densities> densities;
  std::uint32_t largest = 0;
  for (const auto& p : predicted) {
    densities.push_back({svg::bin(p, measured, sheet.predicted, sheet.measured, square, square),
                         svg::bin(measured, residuals(measured, p), sheet.measured, sheet.residual,
                                  columns, rows)});
    largest = std::max(
        {largest, densities.back().agreement.largest(), densities.back().residual.largest()});
  }
  sheet.steps = svg::colour_steps(largest);
  PlotSheet result;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    const auto residual = residuals(measured, predicted[i]);
    result.laws.push_back({agreement_plot(sheet, densities[i], names[i], measured.size()),
                           residual_plot(sheet, densities[i], names[i], measured, residual),
                           outside_text(densities[i], measured.size())});
  }
  result.legend = legend(sheet.steps);
  return result;
}

} // namespace frictab
