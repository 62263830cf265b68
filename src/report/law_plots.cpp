// Draws the two plots of a law, on axes shared by all laws.
#include "report/law_plots.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/text.h"
#include "words/numbers.h"
#include "words/published.h"

namespace frictab::report {

namespace {

// Cells of 5 x 5 pixels: fine enough for the shape, coarse enough for 17 laws on one page.
constexpr std::size_t square = 56, wide = 84;
constexpr double cell_pixels = 5;
constexpr std::size_t colour_classes = 7;
const std::string line_colour = "#c2410c";

std::vector<double> finite_sorted(std::span<const double> values) {
  std::vector<double> kept;
  std::ranges::copy_if(values, std::back_inserter(kept), [](double v) { return std::isfinite(v); });
  std::ranges::sort(kept);
  return kept;
}

std::span<const double> measured_of(const ReportInput& input) {
  return input.validation.has("tau_R_MPa") ? input.validation.values("tau_R_MPa")
                                           : std::span<const double>{};
}

// Range of values that an axis has to include.
struct Extent {
  double low = 0;
  double high = 0;
  void hold(std::span<const double> values, double share) {
    const std::vector<double> sorted = finite_sorted(values);
    if (sorted.empty()) return;
    low = std::min(low, quantile(sorted, share));
    high = std::max(high, quantile(sorted, 1 - share));
  }
  // Limits the range, so that one runaway law does not flatten all others; rows beyond it are
  // counted under its plot.
  void keep_within(double most) {
    low = std::max(low, -most);
    high = std::min(high, most);
  }
};

svg::Density predicted_cells(const ReportInput& input, std::size_t law, const PlotFrame& frame) {
  return svg::bin(input.predicted[law], measured_of(input), frame.predicted, frame.measured, square,
                  square);
}

svg::Density residual_cells(const ReportInput& input, std::size_t law, const PlotFrame& frame) {
  const auto measured = measured_of(input);
  return svg::bin(input.predicted[law], residuals(measured, input.predicted[law]), frame.predicted,
                  frame.residual, wide, square);
}

// Share of the rows per MPa, for each row of cells, smoothed over its neighbours by 1:2:1.
std::vector<double> residual_density(const svg::Density& cells, const svg::Axis& axis) {
  std::vector<double> sums(cells.ny);
  double rows = 0;
  for (std::size_t i = 0; i < cells.counts.size(); ++i) {
    sums[i / cells.nx] += cells.counts[i];
    rows += cells.counts[i];
  }
  const double cell_MPa = (axis.high - axis.low) / static_cast<double>(cells.ny);
  const double per_MPa = 1 / (4 * std::max(rows, 1.0) * cell_MPa);
  std::vector<double> density;
  for (std::size_t i = 0; i < sums.size(); ++i)
    density.push_back(per_MPa * ((i > 0 ? sums[i - 1] : 0) + 2 * sums[i] +
                                 (i + 1 < sums.size() ? sums[i + 1] : 0)));
  return density;
}

std::string beyond(std::size_t outside, std::size_t rows, const char* plot) {
  if (outside == 0) return "";
  const double percent = 100 * static_cast<double>(outside) / static_cast<double>(rows);
  return fmt::format("{} ({} %) lie beyond the axes of the {} plot.",
                     words::count_of(outside, "row"), words::figures(percent, 2), plot);
}

} // namespace

std::vector<double> residuals(std::span<const double> measured, std::span<const double> predicted) {
  std::vector<double> r(std::min(measured.size(), predicted.size()));
  for (std::size_t i = 0; i < r.size(); ++i)
    r[i] = measured[i] - predicted[i];
  return r;
}

double quantile(std::span<const double> sorted, double share) {
  const double x = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(x);
  const double next = sorted[std::min(i + 1, sorted.size() - 1)];
  return sorted[i] + (x - static_cast<double>(i)) * (next - sorted[i]);
}

namespace {

// A 10 % quantile needs some 20 rows.
constexpr std::size_t band_rows = 20;

// `rows`: indices of one group, ascending in x.
void add_group(RunningBand& band, std::span<const double> x, std::span<const double> y,
               std::span<const std::size_t> rows) {
  std::vector<double> xs, ys;
  for (const std::size_t row : rows) {
    xs.push_back(x[row]);
    ys.push_back(y[row]);
  }
  std::ranges::sort(ys);
  band.x.push_back(quantile(xs, 0.5));
  band.low.push_back(quantile(ys, 0.1));
  band.median.push_back(quantile(ys, 0.5));
  band.high.push_back(quantile(ys, 0.9));
}

} // namespace

RunningBand running_band(std::span<const double> x, std::span<const double> y) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  RunningBand band;
  if (order.size() < 3 * band_rows) return band;
  const double width = (x[order.back()] - x[order.front()]) / 30;
  std::size_t first = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool full = i + 1 - first >= band_rows && x[order[i]] - x[order[first]] >= width;
    // Remaining rows that are too few for a group join the last one.
    const bool enough_left = order.size() - i > band_rows;
    if ((full && enough_left) || i + 1 == order.size()) {
      add_group(band, x, y, {order.data() + first, i + 1 - first});
      first = i + 1;
    }
  }
  return band;
}

PlotFrame plot_frame(const ReportInput& input) {
  const auto measured = measured_of(input);
  Extent tau, residual;
  tau.hold(measured, 0);
  const Extent own = tau;
  const bool only_literature = std::ranges::all_of(input.calibration.fits, [](const auto& fit) {
    return words::kind_of(*fit.model.law) == words::LawKind::literature;
  });
  for (std::size_t law = 0; law < input.predicted.size(); ++law) {
    const bool literature =
        words::kind_of(*input.calibration.fits[law].model.law) == words::LawKind::literature;
    tau.hold(input.predicted[law], 0.001);
    if (!literature || only_literature)
      residual.hold(residuals(measured, input.predicted[law]), 0.005);
  }
  const double most = 1.5 * std::max(std::abs(own.low), std::abs(own.high));
  if (most > 0) {
    tau.keep_within(most);
    residual.keep_within(most);
  }
  PlotFrame frame;
  frame.predicted = svg::nice_axis(tau.low, tau.high, 6, "predicted \u03C4_R / MPa");
  frame.measured = svg::nice_axis(tau.low, tau.high, 6, "measured \u03C4_R / MPa");
  frame.residual =
      svg::nice_axis(residual.low, residual.high, 9, "measured \u2212 predicted / MPa");
  std::uint32_t largest = 1;
  for (std::size_t law = 0; law < input.predicted.size(); ++law) {
    const svg::Density residual_counts = residual_cells(input, law, frame);
    for (const svg::Density& cells : {predicted_cells(input, law, frame), residual_counts})
      largest = std::max(largest, *std::ranges::max_element(cells.counts));
    for (const double density : residual_density(residual_counts, frame.residual))
      frame.densest_per_MPa = std::max(frame.densest_per_MPa, density);
  }
  frame.classes = svg::count_classes(largest, colour_classes);
  return frame;
}

LawPlots law_plots(const ReportInput& input, std::size_t law, const PlotFrame& frame) {
  const std::string name = input.calibration.fits[law].model.law->name;
  const auto measured = measured_of(input);
  const std::vector<double> residual = residuals(measured, input.predicted[law]);
  const double low = frame.measured.low, high = frame.measured.high;
  const std::vector<double> ends{low, high}, zeros{0, 0};
  const double side = cell_pixels * static_cast<double>(square);

  svg::Plot left(side, side, frame.predicted, frame.measured);
  const svg::Density left_cells = predicted_cells(input, law, frame);
  left.density(left_cells, frame.classes);
  left.line(ends, ends, {"#111", 1.3, "", true});

  svg::Plot right(cell_pixels * static_cast<double>(wide), side, frame.predicted, frame.residual);
  const svg::Density right_cells = residual_cells(input, law, frame);
  right.density(right_cells, frame.classes);
  right.line(ends, zeros, {"#111", 1.3, "", true});
  const RunningBand band = running_band(input.predicted[law], residual);
  right.line(band.x, band.low, {line_colour, 1.6, "5 3", true});
  right.line(band.x, band.high, {line_colour, 1.6, "5 3", true});
  right.line(band.x, band.median, {line_colour, 2.2, "", true});

  if (frame.densest_per_MPa > 0)
    right.density_beside(residual_density(right_cells, frame.residual), frame.densest_per_MPa,
                         "density");

  const calibrate::Metrics& v = input.calibration.fits[law].validation;
  const std::string figures_text =
      fmt::format("{}, mean absolute error {} MPa, bias {} MPa.", words::count_of(v.n_rows, "row"),
                  words::figures(v.mae_MPa), words::figures(v.bias_MPa));
  LawPlots plots;
  plots.predicted = left.text(name + ": measured against predicted friction shear stress",
                              figures_text + " The line is measured = predicted.");
  plots.residual = right.text(name + ": residual against predicted friction shear stress",
                              figures_text + " Lines: zero, running median, 10 % and 90 %.");
  plots.note = beyond(left_cells.outside, measured.size(), "left");
  const std::string more = beyond(right_cells.outside, measured.size(), "right");
  if (!plots.note.empty() && !more.empty()) plots.note += " ";
  plots.note += more;
  return plots;
}

std::string plot_legend(const PlotFrame& frame) {
  const auto begin = [](std::size_t width, const char* what) {
    return fmt::format("<svg class=\"legend\" width=\"{0}\" viewBox=\"0 0 {0} 46\" role=\"img\" "
                       "aria-label=\"{1}\"><title>{1}</title>\n",
                       width, what);
  };
  const std::size_t n = frame.classes.size();
  std::string text =
      begin(90 + n * 62, "colours of the plots") + "<text x=\"0\" y=\"14\">rows per cell</text>";
  for (std::size_t c = 0; c < n; ++c) {
    const std::size_t x = 90 + c * 62;
    const std::uint32_t from = frame.classes[c];
    std::string label = thousands(from);
    if (c + 1 == n)
      label += "+";
    else if (frame.classes[c + 1] > from + 1)
      label += "\u2013" + thousands(frame.classes[c + 1] - 1);
    text += fmt::format("<rect x=\"{}\" y=\"2\" width=\"62\" height=\"14\" fill=\"{}\"/><text "
                        "x=\"{}\" y=\"32\" text-anchor=\"middle\">{}</text>",
                        x, svg::class_colour(c, n), x + 31, label);
  }
  text += "</svg>\n" + begin(240, "lines of the plots");
  const auto sample = [&](int y, const std::string& colour, const char* extra, const char* what) {
    text += fmt::format(
        "<path fill=\"none\" stroke=\"{}\" {} d=\"M0 {}h34\"/><text x=\"42\" y=\"{}\">{}</text>",
        colour, extra, y, y + 4, what);
  };
  sample(8, "#111", "stroke-width=\"1.3\"", "measured = predicted; zero");
  sample(23, line_colour, "stroke-width=\"2.2\"", "running median of the residual");
  sample(38, line_colour, "stroke-width=\"1.6\" stroke-dasharray=\"5 3\"",
         "10 % and 90 % of the residuals");
  return text + "</svg>";
}

} // namespace frictab::report
