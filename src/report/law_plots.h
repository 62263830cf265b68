// The two plots of a law: measured against predicted, and residual against predicted tau_R.
#pragma once

#include <string>
#include <vector>

#include "report/report.h"
#include "report/svg.h"

namespace frictab::report {

// Axes, cells and colour classes common to all laws, so that their plots can be compared.
struct PlotFrame {
  svg::Axis predicted;
  svg::Axis measured;
  svg::Axis residual;
  std::vector<std::uint32_t> classes; // lower bounds of counts per cell
  double densest_per_MPa = 0;         // largest density of residuals of any law
};

struct LawPlots {
  std::string predicted; // SVG
  std::string residual;  // SVG
  std::string note;      // number of rows that no plot shows; empty where all are shown
};

// Chooses the axes. Those of tau_R include every measured row. The residual axis includes 99 % of
// the rows of every calibrated law; laws with constants of the literature, which would squeeze all
// others, are cut at its ends.
PlotFrame plot_frame(const ReportInput& input);

// Draws the plots of input.calibration.fits[law].
LawPlots law_plots(const ReportInput& input, std::size_t law, const PlotFrame& frame);

// Legend of colours and lines, shared by these plots.
std::string plot_legend(const PlotFrame& frame);

// Running quantiles of y over x: groups of neighbours in x, each of at least 20 rows and a
// thirtieth of the range of x. Empty below 60 rows.
struct RunningBand {
  std::vector<double> x;                 // median of the group
  std::vector<double> low, median, high; // 10 %, 50 %, 90 %
};
RunningBand running_band(std::span<const double> x, std::span<const double> y);

// Measured minus predicted, up to the end of the shorter one.
std::vector<double> residuals(std::span<const double> measured, std::span<const double> predicted);

// Quantile, linear between order statistics; `sorted` is ascending and not empty.
double quantile(std::span<const double> sorted, double share);

} // namespace frictab::report
